// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/hatching.hpp"

#include <string>

#include "core/units.hpp"

namespace strake::drawing {

namespace {

Error fault(const std::string& message) {
  return {ErrorCode::usage, message, "",
          "write 30deg,80mm to hatch all sections so, '30deg: PIPE*' for those of some objects, or "
          "off"};
}

class HatchPattern {
 public:
  explicit HatchPattern(std::string_view text) : text_(text) {}

  Result<hlr::Hatch> parse() {
    for (std::string_view rest = text_;;) {
      const std::size_t comma = rest.find(',');
      if (const Status status = add(rest.substr(0, comma)); !status) return status.error();
      if (comma == std::string_view::npos) return hatch_;
      rest.remove_prefix(comma + 1);
    }
  }

 private:
  static std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

  Status add(std::string_view part) {
    const auto quantity = parse_quantity(part);
    if (!quantity) return fault(quoted(part) + " is neither an angle nor a length");
    if (unit_mm(quantity->unit)) return add_spacing(part);
    // Which of 30,80 is what is anybody's guess, and 1,5mm has a decimal comma.
    if (quantity->unit.empty() && text_.find(',') != std::string_view::npos)
      return fault(quoted(part) + " in " + quoted(text_) +
                   " has no unit, and a comma parts the angle from the distance");
    return add_angle(part);
  }

  Status add_angle(std::string_view part) {
    const Result<double> angle = parse_angle_deg(part);
    if (!angle) return fault(quoted(part) + " is neither an angle nor a length");
    if (!(*angle >= 0 && *angle <= 180))
      return fault(quoted(part) + " is not between 0deg and 180deg");
    if (has_angle_) return fault(quoted(text_) + " says the angle twice");
    has_angle_ = true;
    hatch_.angle_deg = *angle;
    return {};
  }

  Status add_spacing(std::string_view part) {
    const Result<double> length = parse_distance_mm(part);
    if (!length) return fault(length.error().message);
    if (!(*length > 0)) return fault(quoted(part) + " is no distance between lines");
    if (has_spacing_) return fault(quoted(text_) + " says the distance of lines twice");
    has_spacing_ = true;
    hatch_.spacing_mm = *length;
    return {};
  }

  std::string_view text_;
  hlr::Hatch hatch_;
  bool has_angle_ = false, has_spacing_ = false;
};

}  // namespace

Result<hlr::Hatch> parse_hatch(std::string_view text) {
  if (text != "off") return HatchPattern(text).parse();
  hlr::Hatch hatch;
  hatch.spacing_mm = 0;
  return hatch;
}

void Hatching::add(const hlr::Hatch& hatch, const std::vector<bool>& picked) {
  hatches_.resize(objects_);
  known_.resize(objects_, false);
  for (std::size_t o = 0; o < objects_; ++o) {
    if (known_[o] || (!picked.empty() && !picked[o])) continue;
    known_[o] = true;
    hatches_[o] = hatch;
  }
}

}  // namespace strake::drawing
