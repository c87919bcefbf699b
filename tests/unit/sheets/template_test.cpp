// SPDX-License-Identifier: Apache-2.0
// Templates: what is kept of them, and what is refused.
#include "sheets/spec/template.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace strake::sheets {
namespace {

std::string svg(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"420mm\" "
         "height=\"297mm\" viewBox=\"0 0 420 297\">" +
         inside + "</svg>";
}

std::string fault_of(const std::string& text) {
  const auto parsed = parse_template(text);
  return parsed ? std::string() : parsed.error().text();
}

std::string kept(const std::string& inside) {
  const auto parsed = parse_template(svg(inside));
  EXPECT_TRUE(parsed) << parsed.error().text();
  return parsed ? fill_placeholders(parsed->pieces,
                                    [](const std::string& name) { return "<" + name + ">"; })
                : std::string();
}

TEST(Template, DrawingIsKeptAndFieldsAreFilled) {
  EXPECT_EQ(
      kept("<g id='a'><path d='M0 0\nL1 1'/><!-- no --><text x=\"1\">No. {{ number }} "
           "&amp; &#x41;</text></g>"),
      "<g id=\"a\"><path d=\"M0 0 L1 1\"></path><text x=\"1\">No. <number> &amp; A</text></g>");
  const auto parsed = parse_template(svg("<text>{{a}}<tspan>{{b}} {{a}}</tspan></text>"));
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->fields(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(parsed->width_mm, 420);
  EXPECT_EQ(parsed->view_box, "0 0 420 297");
}

TEST(Template, WhatEditorsLeaveIsPassedOver) {
  EXPECT_EQ(kept("<metadata><rdf:RDF xmlns:rdf='x'><script>no</script></rdf:RDF></metadata>"
                 "<sodipodi:namedview showgrid='true'><inkscape:grid/></sodipodi:namedview>"
                 "<rect inkscape:label='r' sodipodi:x='1' width='1'/>"),
            "<rect inkscape:label=\"r\" width=\"1\"></rect>");
  EXPECT_EQ(kept("<style>.a &gt; b { fill: url(#p) }</style><use xlink:href='#a'/>"
                 "<image href='data:image/png;base64,AAAA'/>"),
            "<style>.a &gt; b { fill: url(#p) }</style><use xlink:href=\"#a\"></use>"
            "<image href=\"data:image/png;base64,AAAA\"></image>");
}

TEST(Template, WhatIsMoreThanDrawingIsRefused) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"", "there is no element"},
      {"just text", "text outside of the drawing"},
      {"{\"a\": 1}", "text outside of the drawing"},
      {"<html><body/></html>", "line 1: the outermost element is <html>, not <svg>"},
      {"<svg:svg/>", "the outermost element is <svg:svg>"},
      {"<svg width='100' height='100mm' viewBox='0 0 1 1'/>", "the width of the template is '100'"},
      {"<svg width='0mm' height='100mm' viewBox='0 0 1 1'/>", "the width of the template is '0mm'"},
      {"<svg viewBox='0 0 1 1'/>", "does not say its size"},
      {"<svg width='100mm' height='100mm'/>", "no viewBox of four numbers"},
      {"<svg width='100mm' height='100mm' viewBox='0 0 1'/>", "no viewBox"},
      {"<svg width='100mm' height='100mm' viewBox='0 0 nan 1'/>", "no viewBox"},
      {"<svg width='100mm' height='100mm' viewBox='0 0 0 1'/>", "no viewBox"},
      {svg("<g>"), "</svg> closes nothing"},
      {svg("<g></p>"), "</p> closes nothing"},
      {svg("") + "<svg/>", "something follows"},
      {"<svg", "a name is missing"},
      {svg("<a b/>"), "'b' has no value"},
      {svg("<g a='1' a='2'/>"), "'a' is given twice"},
      {svg("<g a='<'/>"), "'<' stands in a value"},
      {svg("<text>&nbsp;</text>"), "'&nbsp;' stands for nothing"},
      {svg("<text>&#0;</text>"), "'&#0;' stands for nothing"},
      {svg("<text>&#x110000;</text>"), "stands for nothing"},
      {svg("<text>\xFF</text>"), "the text is no UTF-8"},
      {"<!DOCTYPE svg [<!ENTITY a \"b\">]>" + svg(""), "a document type has no place"},
      {svg("<!ENTITY a SYSTEM \"file:///etc/passwd\">"), "a document type has no place"},
      {"<?xml-stylesheet href=\"a.css\"?>" + svg(""), "a processing instruction has no place"},
      {svg("\n<script>alert(1)</script>"), "line 3: <script> has no place in a template"},
      {svg("<foreignObject/>"), "<foreignObject> has no place"},
      {svg("<animate/>"), "<animate> has no place"},
      {svg("<a href='#x'/>"), "<a> has no place"},
      {svg("<g onload='x()'/>"), "'onload' of <g> has no place"},
      {svg("<g ONCLICK='x()'/>"), "'ONCLICK' of <g>"},
      {svg("<image href='http://x/y.png'/>"), "the reference 'http://x/y.png' of <image>"},
      {svg("<image xlink:href='file:///etc/passwd'/>"), "the reference"},
      {svg("<image href='data:image/svg+xml;base64,AAAA'/>"), "the reference"},
      {svg("<use href='javascript:x'/>"), "the reference"},
      {svg("<rect fill='URL( \"http://x\" )'/>"), "'url(...)' of <rect>"},
      {svg("<rect style='fill:u\\72l(http://x)'/>"), "'\\' in 'style'"},
      {svg("<style>@import 'x';</style>"), "'@import' has no place in the style"},
      {svg("<style>a{b:url(x)}</style>"), "'url(...)' has no place in the style"},
      {svg("<style><![CDATA[a{b:\\75rl(x)}]]></style>"), "'\\' has no place in the style"},
      {svg("<g>text</g>"), "text stands in <g>"},
      {svg("<text>{{a</text>"), "a '{{' is not closed"},
      {svg("<text>{{ }}</text>"), "names nothing"},
      {svg("<g id='view-1'/>"), "the id 'view-1' is one of the drawing's own"}};
  for (const auto& [text, want] : faults) {
    const std::string fault = fault_of(text);
    EXPECT_NE(fault.find(want), std::string::npos) << text << "\n-> " << fault;
  }
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_NE(fault_of(svg(deep)).find("nested too deeply"), std::string::npos);
}

/// `levels` groups, each of which draws the one before it twice by the attribute or element `draw`.
std::string bomb(int levels, const std::function<std::string(const std::string&)>& draw) {
  std::string text = "<g id='l0'><path d='M0 0'/></g>\n";
  for (int i = 1; i <= levels; ++i) {
    const std::string once = draw("l" + std::to_string(i - 1));
    text += "<g id='l" + std::to_string(i) + "'>" + once + once + "</g>\n";
  }
  return svg(text + draw("l" + std::to_string(levels)));
}

/// Every way in which one element draws another.
std::vector<std::function<std::string(const std::string&)>> ways_to_draw() {
  return {[](const std::string& id) { return "<use href='#" + id + "'/>"; },
          [](const std::string& id) { return "<use xlink:href='#" + id + "'/>"; },
          [](const std::string& id) { return "<rect fill='url(#" + id + ")'/>"; },
          [](const std::string& id) { return "<rect stroke='URL( \"#" + id + "\" ) none'/>"; },
          [](const std::string& id) { return "<g mask='url(#" + id + ")'/>"; },
          [](const std::string& id) { return "<g clip-path=\"url('#" + id + "')\"/>"; },
          [](const std::string& id) { return "<path style='a:b;marker-end:url(#" + id + ")'/>"; },
          [](const std::string& id) { return "<pattern href='#" + id + "'/>"; }};
}

TEST(Template, WhatDrawsItselfIsRefused) {
  for (const auto& draw : ways_to_draw()) {
    for (int length = 1; length <= 5; ++length) {
      std::string circle;
      for (int i = 0; i < length; ++i)
        circle += "\n<g id='c" + std::to_string(i) + "'><g>" +
                  draw("c" + std::to_string((i + 1) % length)) + "</g></g>";
      const std::string reported = fault_of(svg(circle));
      EXPECT_NE(reported.find("is drawn within itself"), std::string::npos) << circle << reported;
      EXPECT_NE(reported.find("line " + std::to_string(length + 2)), std::string::npos) << reported;
      // Without its last link it is a chain.
      EXPECT_EQ(fault_of(svg(circle.substr(0, circle.rfind("<g id=")))), "");
    }
  }
  // A chain, however long, is no circle.
  std::string chain = "<path id='p0'/>";
  for (int i = 1; i < 20000; ++i)
    chain += "<g id='p" + std::to_string(i) + "'><use href='#p" + std::to_string(i - 1) + "'/></g>";
  EXPECT_EQ(fault_of(svg(chain)).find("within itself"), std::string::npos);
}

TEST(Template, WhatDrawsWithoutEndIsRefused) {
  for (const auto& draw : ways_to_draw()) {
    EXPECT_EQ(fault_of(bomb(10, draw)), "");
    for (const int levels : {20, 64, 200}) {
      const std::string reported = fault_of(bomb(levels, draw));
      EXPECT_NE(reported.find("the references draw more than"), std::string::npos) << reported;
      EXPECT_NE(reported.find("line "), std::string::npos) << reported;
    }
  }
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "<use href='#p'/>";
  EXPECT_EQ(fault_of(svg("<path id='p'/>" + many)), "") << "in proportion to what is there";
}

TEST(Template, ReferencesMeanTheSameToEverybody) {
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"<g id='a'/><g id='a'/><use href='#a'/>", "several elements have that id"},
           {"<g id='a'><use href='#%61'/></g>", "'%' stands in the reference"},
           {"<g id='a&#10;b'><use href='#a b'/></g>", "a blank stands in the reference"},
           {"<g id='a b'><path fill=\"url('#a b')\"/></g>", "a blank stands in the reference"},
           {"<g id='a'><use href='#a '/></g>", "a blank stands in the reference"},
           {"<g id='a'><use href='#a&#10;'/></g>", "a blank stands in the reference"},
           {"<g id='a'><use href='#&#9;a'/></g>", "a blank stands in the reference"},
           {"<g id='a'><rect fill=\"url('#a ')\"/></g>", "a blank stands in the reference"},
           {"<pattern id='p'/><style>a{fill:url(#p)}</style>",
            "'url(#p)' has no place in the style"},
           {"<style>@im<![CDATA[port 'x']]></style>", "'@import'"},
           {"<style>a{b:ur<!-- -->l(x)}</style>", "'url(...)'"}})
    EXPECT_NE(fault_of(svg(text)).find(what), std::string::npos) << text << fault_of(svg(text));
  for (const std::string text :
       {"<g id='a'/><g id='a'/>", "<use href='#nothing'/>", "<rect width='50%' fill='url(#x)'/>",
        "<linearGradient id='l'/><style>a{width:50%;fill:url(#l)}</style>"})
    EXPECT_EQ(fault_of(svg(text)), "") << text;
}

}  // namespace
}  // namespace strake::sheets
