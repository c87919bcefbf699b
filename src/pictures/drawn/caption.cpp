// SPDX-License-Identifier: Apache-2.0
#include "pictures/drawn/caption.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::pictures {
namespace {

constexpr Colour kInk{0x22, 0x22, 0x22};
constexpr double kTextMm = 2.2, kMargin = 2.5;

/// Returns at most so many characters of a text: where it is longer, its beginning and its end.
std::string shortened(std::string_view text, std::size_t limit) {
  std::vector<std::string_view> characters;
  for (std::string_view rest = text; !rest.empty();)
    characters.push_back(decode_character(rest).bytes);
  if (characters.size() <= limit) return std::string(text);
  constexpr std::string_view kGap = "...";
  const std::size_t kept = limit - std::min(limit, kGap.size()), front = (kept + 1) / 2;
  std::string out;
  for (std::size_t i = 0; i < front; ++i) out += characters[i];
  out += kGap;
  for (std::size_t i = characters.size() - (kept - front); i < characters.size(); ++i)
    out += characters[i];
  return out;
}

/// Returns how many characters of a height fit a width.
std::size_t fitting(double width_mm, double height_mm) {
  constexpr double kWidthOfCharacter = 0.86;
  return static_cast<std::size_t>(std::max(8.0, width_mm / (height_mm * kWidthOfCharacter)));
}

/// Returns the usual length nearest below one: 1, 2 or 5 times a power of ten.
double usual_length(double mm) {
  double power = 1;
  while (power * 10 <= mm) power *= 10;
  while (power > mm) power /= 10;
  return mm >= 5 * power ? 5 * power : mm >= 2 * power ? 2 * power : power;
}

std::string length_text(double mm) {
  constexpr double kMetre = 1000;
  return mm >= kMetre ? shortest(mm / kMetre) + " m" : shortest(mm) + " mm";
}

void add_scale_bar(ClashPicture& picture, double baseline) {
  const double length = usual_length(picture.width_mm * 0.22 * picture.mm_per_mm);
  const double width = length / picture.mm_per_mm, right = picture.width_mm - kMargin;
  constexpr double kThick = 0.9;
  picture.blocks.push_back({{right - width, baseline - kThick}, width / 2, kThick, kInk});
  picture.blocks.push_back(
      {{right - width / 2, baseline - kThick}, width / 2, kThick, {0xbb, 0xbb, 0xbb}});
  picture.texts.push_back(
      {{right - width / 2, baseline - 2.2}, kTextMm, length_text(length), kInk, true, false});
}

}  // namespace

std::string name_of(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  std::string name = trimmed(object.name).empty() ? object.id : object.name;
  if (model.files.size() > 1) name += " (" + model.files[object.file].label + ")";
  return name;
}

std::string title_of(const report::ClashContents& contents, const Subject& subject) {
  const clash::Pair& pair = pair_of(contents, subject.results.front());
  std::string title;
  switch (pair.cls) {
    case clash::Class::hit:
      title = pair.d_mm < 0 ? "Hit, " + fixed(-pair.d_mm, 1) + " mm deep" : "Hit";
      break;
    case clash::Class::contact:
      title = "Contact";
      break;
    case clash::Class::clearance_violation:
      title = "Too near, " + fixed(pair.d_mm, 1) + " mm apart";
      break;
    case clash::Class::no_hit:
      title = "No hit";
      break;
  }
  if (subject.results.size() > 1)
    title += "; the worst of " + std::to_string(subject.results.size());
  const std::string& test = contents.findings.tests[subject.results.front().test].name;
  if (!test.empty()) title += " (" + test + ")";
  return title;
}

void add_caption(ClashPicture& picture, const model::Model& model, const Roles& roles,
                 bool cut_open) {
  const double top = picture.view_mm, width = picture.width_mm - 2 * kMargin;
  const double beside_bar = picture.width_mm * 0.72 - 2 * kMargin;
  constexpr double kTitleMm = 2.6, kSwatch = 2.6;
  picture.blocks.push_back({{0, top}, picture.width_mm, 0.25, {0x99, 0x99, 0x99}});
  std::string title = picture.title;
  if (cut_open) title += "; cut open to show it";
  picture.texts.push_back({{kMargin, top + 5.2},
                           kTitleMm,
                           shortened(title, fitting(width, kTitleMm)),
                           kInk,
                           false,
                           true});
  double line = top + 11.2;
  for (const Role role : {Role::a, Role::b}) {
    picture.blocks.push_back({{kMargin, line - kSwatch + 0.2},
                              kSwatch,
                              kSwatch,
                              role == Role::a ? kColourOfA : kColourOfB});
    const std::string name = name_of(model, roles.first(role));
    picture.texts.push_back({{kMargin + kSwatch + 1.6, line},
                             kTextMm,
                             shortened(name, fitting(beside_bar, kTextMm)),
                             kInk,
                             false,
                             false});
    line += 5.6;
  }
  add_scale_bar(picture, top + kCaptionMm - 4);
}

}  // namespace strake::pictures
