// SPDX-License-Identifier: Apache-2.0
#include "core/text/xml_text.hpp"

#include <gtest/gtest.h>

namespace strake {
namespace {

std::string as_xml(std::string_view text, XmlCharacters kept) {
  std::string out;
  append_xml(out, text, kept);
  return out;
}

TEST(XmlText, IsNoMarkup) {
  for (const XmlCharacters kept :
       {XmlCharacters::printable, XmlCharacters::lines, XmlCharacters::all})
    EXPECT_EQ(as_xml("<a b=\"c\" d='e'> & ]]> \xC3\xA4 \xF0\x9F\x9A\xA2", kept),
              "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt; &amp; ]]&gt; \xC3\xA4 \xF0\x9F\x9A\xA2");
}

TEST(XmlText, KeepsWhatIsRequested) {
  const std::string lost(kReplacement);
  const std::string given = "a\tb\nc\r\x7F\xE2\x80\xAE";
  EXPECT_EQ(as_xml(given, XmlCharacters::printable),
            "a" + lost + "b" + lost + "c" + lost + lost + lost);
  EXPECT_EQ(as_xml(given, XmlCharacters::lines), "a\tb\nc&#13;" + lost + lost);
  EXPECT_EQ(as_xml(given, XmlCharacters::all), "a\tb\nc&#13;\x7F\xE2\x80\xAE");
}

TEST(XmlText, HasNothingThatXmlCannotHold) {
  const std::string lost(kReplacement);
  for (const XmlCharacters kept :
       {XmlCharacters::printable, XmlCharacters::lines, XmlCharacters::all}) {
    EXPECT_EQ(as_xml(std::string("a\0b\x01\x1F\xFF", 6), kept),
              "a" + lost + "b" + lost + lost + lost);
    EXPECT_EQ(as_xml("\xEF\xBF\xBE\xEF\xBF\xBF", kept), lost + lost);
  }
}

}  // namespace
}  // namespace strake
