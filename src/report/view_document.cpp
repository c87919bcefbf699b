// SPDX-License-Identifier: Apache-2.0
#include "strake/report/view_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "report/document_fault.hpp"
#include "report/document_file.hpp"
#include "report/json_reader.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

constexpr DocumentKind kView{"strake draw -o FILE.json", "draw it again"};
constexpr std::string_view kVersion = "1";
/// No part of the schema is nested more deeply.
constexpr int kMaxDepth = 8;
/// Nothing can be placed farther out (geometry::snap), in the model or on a sheet.
constexpr double kFarthestMm = 2e12;
constexpr std::uint32_t kNone = 0xffffffffU;

template <class Enum, class Name>
std::optional<Enum> named(std::string_view text, Name&& name) {
  for (std::uint8_t i = 0; !name(static_cast<Enum>(i)).empty(); ++i)
    if (name(static_cast<Enum>(i)) == text) return static_cast<Enum>(i);
  return std::nullopt;
}

/// Pieces are taken as they come; the rest is small.
class Reader {
 public:
  Reader(std::istream& in, ViewDocument& document) : json_(in, kMaxDepth), document_(document) {}

  void read() {
    if (json_.kind() == Kind::object)
      json_.members([this](std::string_view key) { section(key); });
    else
      json_.skip();
    json_.end();
    if (!met_.contains("schema_version")) throw DocumentFault{"the document", "is no drawing"};
    for (const char* const key :
         {"view", "settings", "sheet", "counts", "hash", "objects", "pieces"})
      if (!met_.contains(key)) throw lacks("the document", key);
    check_objects();
    check_counts();
  }

 private:
  void section(std::string_view key) {
    if (!met_.emplace(key).second)
      throw contradicts("the document", "has \"" + std::string(key) + "\" twice");
    if (key == "schema_version")
      version();
    else if (key == "view" || key == "settings")
      settings(std::string(key));
    else if (key == "sheet")
      sheet();
    else if (key == "counts")
      counts();
    else if (key == "hash")
      document_.hash = text("the document", "hash");
    else if (key == "objects")
      objects();
    else if (key == "pieces")
      pieces();
    else
      json_.skip();
  }

  void must_be(Kind kind, const std::string& where, std::string_view key, const char* what) {
    if (json_.kind() != kind) throw is_not(where, key, what);
  }

  std::string text(const std::string& where, std::string_view key) {
    must_be(Kind::string, where, key, "text");
    return std::string(json_.text());
  }

  double number(const std::string& where, std::string_view key) {
    const double value = json_.kind() == Kind::number ? json_.number() : HUGE_VAL;
    if (!(std::fabs(value) <= kFarthestMm)) throw is_not(where, key, "number that makes sense");
    return value;
  }

  /// At once: drawings of other versions look otherwise.
  void version() {
    std::string said;
    json_.copy(said);
    if (said != kVersion)
      throw DocumentFault{"the document", "is no drawing of schema version " +
                                              std::string(kVersion) + ": it says version " + said};
  }

  void settings(const std::string& section) {
    must_be(Kind::object, "the document", section, "object");
    json_.members([&](std::string_view key) {
      std::string& value = document_.settings[section + "." + std::string(key)];
      if (!value.empty()) throw contradicts(section, "has \"" + std::string(key) + "\" twice");
      json_.copy(value);
    });
  }

  void sheet() {
    must_be(Kind::object, "the document", "sheet", "object");
    const std::array<std::pair<std::string_view, double*>, 3> known{
        {{"width_mm", &document_.width_mm},
         {"height_mm", &document_.height_mm},
         {"scale", &document_.scale}}};
    json_.members([&](std::string_view key) {
      const std::string name(key);
      const auto* const at = std::ranges::find(known, name, [](const auto& k) { return k.first; });
      if (at == known.end()) return json_.skip();
      *at->second = number("sheet", name);
    });
    for (const auto& [key, value] : known)
      if (!(*value > 0)) throw is_not("sheet", key, "positive number");
  }

  void counts() {
    must_be(Kind::object, "the document", "counts", "object");
    json_.members([&](std::string_view key) {
      const std::string name(key);
      counted_[name] = number("counts", name);
    });
  }

  void objects() {
    must_be(Kind::array, "the document", "objects", "list");
    json_.items([this] {
      const std::string where = "objects[" + std::to_string(document_.objects.size()) + "]";
      if (json_.kind() != Kind::object) throw DocumentFault{where, "is no object"};
      ViewObject object;
      std::array<bool, 3> there{};
      json_.members([&](std::string_view key) {
        const std::string name(key);
        const auto take = [&](std::size_t i, std::string& into) {
          into = text(where, name);
          there.at(i) = true;
        };
        if (name == "id")
          take(0, object.id);
        else if (name == "name")
          take(1, object.name);
        else if (name == "file")
          take(2, object.file);
        else
          json_.skip();
      });
      for (const auto& [i, key] : {std::pair(0, "id"), std::pair(1, "name"), std::pair(2, "file")})
        if (!there.at(static_cast<std::size_t>(i))) throw lacks(where, key);
      document_.objects.push_back(std::move(object));
    });
  }

  void pieces() {
    must_be(Kind::array, "the document", "pieces", "list");
    json_.items([this] { piece(); });
  }

  [[nodiscard]] std::string where() const {
    return "pieces[" + std::to_string(document_.pieces.size()) + "]";
  }

  void piece() {
    if (json_.kind() != Kind::object) throw DocumentFault{where(), "is no object"};
    ViewPiece piece;
    piece.object = piece.other = kNone;
    there_ = {};
    json_.members([&](std::string_view key) { piece_member(key, piece); });
    constexpr std::array<const char*, kMembers> kKeys{
        "object_index", "kind", "state", "a_mm", "b_mm", "a_paper_mm", "b_paper_mm"};
    for (std::size_t i = 0; i < kMembers; ++i)
      if (!there_.at(i)) throw lacks(where(), kKeys.at(i));
    if (piece.kind == hlr::EdgeKind::intersection && piece.other == kNone)
      throw lacks(where(), "other_index");
    if (piece.kind != hlr::EdgeKind::intersection) piece.other = piece.object;
    document_.pieces.push_back(piece);
  }

  void piece_member(std::string_view key, ViewPiece& piece) {
    if (key == "object_index") {
      piece.object = index("object_index");
      there_[0] = true;
    } else if (key == "other_index") {
      piece.other = index("other_index");
    } else if (key == "kind") {
      if (json_.kind() != Kind::string) throw is_not(where(), "kind", "text");
      const auto kind = named<hlr::EdgeKind>(json_.text(), drawing::kind_name);
      if (!kind) throw is_not(where(), "kind", "kind of line that this version knows");
      piece.kind = *kind;
      there_[1] = true;
    } else if (key == "state") {
      if (json_.kind() != Kind::string) throw is_not(where(), "state", "text");
      const auto state = named<drawing::LineState>(json_.text(), drawing::state_name);
      if (!state) throw is_not(where(), "state", "state that this version knows");
      piece.state = *state;
      there_[2] = true;
    } else if (key == "a_mm" || key == "b_mm") {
      (key[0] == 'a' ? piece.a : piece.b) = model_point(key[0] == 'a' ? "a_mm" : "b_mm");
    } else if (key == "a_paper_mm" || key == "b_paper_mm") {
      (key[0] == 'a' ? piece.a_paper : piece.b_paper) =
          paper_point(key[0] == 'a' ? "a_paper_mm" : "b_paper_mm");
    } else {
      json_.skip();
    }
  }

  std::uint32_t index(const char* key) {
    const double value = json_.kind() == Kind::number ? json_.number() : -1;
    if (!(value >= 0 && value < kNone) || value != std::floor(value))
      throw is_not(where(), key, "number of an object");
    return static_cast<std::uint32_t>(value);
  }

  /// So many numbers.
  template <std::size_t N>
  std::array<double, N> numbers(const char* key) {
    if (json_.kind() != Kind::array) throw is_not(where(), key, "point");
    std::array<double, N> values{};
    std::size_t k = 0;
    json_.items([&] {
      const double value = json_.kind() == Kind::number ? json_.number() : HUGE_VAL;
      if (!(std::fabs(value) <= kFarthestMm) || k >= N) throw is_not(where(), key, "point");
      values.at(k++) = value;
    });
    if (k != N) throw is_not(where(), key, "point");
    return values;
  }

  geometry::Vec3l model_point(const char* key) {
    const auto mm = numbers<3>(key);
    there_[key[0] == 'a' ? 3 : 4] = true;
    const auto um = [](double v) { return static_cast<std::int64_t>(std::llround(v * 1000)); };
    return {um(mm[0]), um(mm[1]), um(mm[2])};
  }

  std::array<float, 2> paper_point(const char* key) {
    const auto mm = numbers<2>(key);
    there_[key[0] == 'a' ? 5 : 6] = true;
    return {static_cast<float>(mm[0]), static_cast<float>(mm[1])};
  }

  void check_objects() const {
    std::set<std::pair<std::string_view, std::string_view>> ids;
    for (const ViewObject& object : document_.objects)
      if (!ids.emplace(object.file, object.id).second)
        throw contradicts("object '" + object.id + "' of '" + object.file + "'",
                          "stands there twice");
    for (std::size_t p = 0; p < document_.pieces.size(); ++p) {
      const ViewPiece& piece = document_.pieces[p];
      if (std::max(piece.object, piece.other) >= document_.objects.size())
        throw contradicts("pieces[" + std::to_string(p) + "]",
                          "is of object " + std::to_string(std::max(piece.object, piece.other)) +
                              ", but there are " + std::to_string(document_.objects.size()));
    }
  }

  void check_counts() const {
    std::map<std::string, double> there;
    std::array<double, drawing::kLineStates> of_state{};
    for (const ViewPiece& piece : document_.pieces)
      ++of_state.at(static_cast<std::size_t>(piece.state));
    for (std::size_t s = 0; s < drawing::kLineStates; ++s)
      there[std::string(drawing::state_name(static_cast<drawing::LineState>(s)))] = of_state.at(s);
    there["pieces"] = static_cast<double>(document_.pieces.size());
    for (const auto& [key, count] : there) {
      const auto said = counted_.find(key);
      if (said == counted_.end()) throw lacks("counts", key);
      if (said->second != count)
        throw contradicts("the document", "counts " + whole(said->second) + " of \"" + key +
                                              "\", but lists " + whole(count));
    }
  }

  static std::string whole(double value) { return std::to_string(static_cast<long long>(value)); }

  static constexpr std::size_t kMembers = 7;
  JsonReader json_;
  ViewDocument& document_;
  std::set<std::string, std::less<>> met_;
  std::map<std::string, double> counted_;
  std::array<bool, kMembers> there_{};  ///< members of the piece in hand
};

}  // namespace

Result<ViewDocument> parse_view_document(std::istream& in, const std::string& name) {
  ViewDocument document;
  document.name = name;
  const Status status = read_guarded(name, kView, [&] { Reader(in, document).read(); });
  if (!status) return status.error();
  return document;
}

Result<ViewDocument> read_view_document(const std::filesystem::path& file) {
  Result<std::ifstream> in = open_document(file);
  if (!in) return in.error();
  return parse_view_document(*in, file.string());
}

}  // namespace strake::report
