// SPDX-License-Identifier: Apache-2.0
#include "bcf/xml/xml_text.hpp"

#include <gtest/gtest.h>

#include "bcf/input/xml_tree.hpp"

namespace strake::bcf {
namespace {

TEST(XmlText, IsReadAsItIs) {
  const std::string text = "a<b>&\"'\r\n\t ]]> \xC3\xA4 \xF0\x9F\x9A\xA2";
  XmlWriter writer("Root");
  writer.attribute("A", "x\"<&>").begin("Empty").end().leaf("Text", text).leaf_if("None", " \n");
  pugi::xml_document document;
  ASSERT_TRUE(read_xml(document, writer.finish(), "here"));
  const pugi::xml_node root = child(document, "Root");
  EXPECT_EQ(attribute_text(root, "A"), "x\"<&>");
  EXPECT_TRUE(child(root, "Empty"));
  EXPECT_FALSE(child(root, "None"));
  EXPECT_EQ(child_text(root, "Text"), text);
}

TEST(XmlText, IsComparedWithoutItsLayout) {
  EXPECT_EQ(compared_text(" as\r\n agreed\t. "), "as agreed .");
  EXPECT_EQ(compared_text("\n"), "");
}

TEST(XmlText, LongNamesLoseTheirMiddle) {
  EXPECT_EQ(short_name("abcdef", 6), "abcdef");
  EXPECT_EQ(short_name("abcdefg", 6),
            "ab\xE2\x80\xA6"
            "efg");
  EXPECT_EQ(short_name("a\nb\xE2\x80\xAE", 6), "a?b?");
}

TEST(XmlTree, DeclaresNoEntities) {
  pugi::xml_document document;
  ASSERT_TRUE(read_xml(
      document, "<!DOCTYPE x [<!ENTITY e SYSTEM \"file:///etc/passwd\">]><p:x><t>&e;</t></p:x>",
      "here"));
  EXPECT_EQ(child_text(child(document, "x"), "t"), "&e;");
}

TEST(XmlTree, IsAnErrorWhereItIsDamaged) {
  pugi::xml_document document;
  const Status status = read_xml(document, "<a><b></a>", "here");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::input);
  EXPECT_EQ(status.error().where, "here");
}

}  // namespace
}  // namespace strake::bcf
