// SPDX-License-Identifier: Apache-2.0
#include "strake/report/view_document.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <set>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>

#include "core/checksum.hpp"
#include "drawing/neutral/neutral_rows.hpp"
#include "report/document/document_reader.hpp"
#include "report/json/json_reader.hpp"
#include "report/view/view_details.hpp"
#include "report/view/view_line_reader.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

constexpr DocumentKind kView{"strake draw -o", "draw it again"};
constexpr std::string_view kVersion = "1";
/// The deepest nesting of the schema.
constexpr int kMaxViewDepth = 8;

/// Reads the text of a document: pieces one by one; the rest is small.
class ViewDocumentReader {
 public:
  /// In a binary document the lines follow the text, as rows. `details` takes what a comparison
  /// does not need; null: nothing does.
  ViewDocumentReader(std::istream& text, bool binary, ViewDocument& document, ViewDetails* details)
      : json_(text, kMaxViewDepth),
        binary_(binary),
        lines_key_(binary ? "rows" : "pieces"),
        document_(document),
        details_(details) {}

  void read_text() {
    if (json_.kind() == Kind::object)
      json_.members([this](std::string_view key) { section(key); });
    else
      json_.skip();
    json_.end();
    if (!met_.contains("schema_version")) throw DocumentFault{"the document", "is no drawing"};
    for (const std::string_view key : std::initializer_list<std::string_view>{
             "view", "settings", "sheet", "counts", "hash", "objects", lines_key_})
      if (!met_.contains(key)) throw missing_key("the document", key);
  }

  /// Reads the rows that the text announces.
  void read_rows(std::istream& in, Checksum& before) {
    report::read_rows(in, *rows_, stated("pieces"), before,
                      [this](const ReadPiece& piece) { take(piece); });
  }

  void check() {
    check_objects();
    check_counts();
    if (details_ == nullptr) return;
    check_curves();
    details_->counts = std::move(counted_);
  }

 private:
  void section(std::string_view key) {
    if (!met_.emplace(key).second)
      throw contradiction("the document", "has \"" + std::string(key) + "\" twice");
    if (key == "schema_version")
      version();
    else if (key == "view" || key == "settings")
      settings(std::string(key));
    else if (key == "sheet")
      sheet();
    else if (key == "counts")
      counts();
    else if (key == "hash")
      document_.hash = fields_.text("the document", "hash");
    else if (key == "objects")
      objects("objects", document_.objects);
    else if (key == "far_objects")
      objects("far_objects", document_.far_objects);
    else if (key == lines_key_)
      lines();
    else if (details_ != nullptr && key == "curves")
      read_curves(json_, *details_);
    else if (details_ != nullptr && key == "defects")
      read_defects(json_, *details_);
    else if (details_ != nullptr && key == "files_ending_early")
      read_cut_files(json_, *details_);
    else if (key == "pieces" || key == "rows")
      throw DocumentFault{"the document", "has \"" + std::string(key) +
                                              "\" beside or instead of its " + lines_key_};
    else
      json_.skip();
  }

  /// Checks the version at once: drawings of other versions have another form.
  void version() {
    std::string stated;
    json_.copy(stated);
    if (stated != kVersion)
      throw DocumentFault{"the document", "is no drawing of schema version " +
                                              std::string(kVersion) + ": it says version " +
                                              stated};
  }

  void settings(const std::string& section) {
    fields_.must_be(Kind::object, "the document", section, "object");
    json_.members([&](std::string_view key) {
      std::string& value = document_.settings[section + "." + std::string(key)];
      if (!value.empty()) throw contradiction(section, "has \"" + std::string(key) + "\" twice");
      json_.copy(value);
    });
  }

  void sheet() {
    fields_.must_be(Kind::object, "the document", "sheet", "object");
    const std::array<std::pair<std::string_view, double*>, 3> known{
        {{"width_mm", &document_.width_mm},
         {"height_mm", &document_.height_mm},
         {"scale", &document_.scale}}};
    json_.members([&](std::string_view key) {
      const std::string name(key);
      const auto* const at = std::ranges::find(known, name, [](const auto& k) { return k.first; });
      if (at == known.end()) return rest_of_sheet(name);
      *at->second = fields_.number("sheet", name);
    });
    for (const auto& [key, value] : known)
      if (!(*value > 0)) throw wrong_type("sheet", key, "positive number");
  }

  void rest_of_sheet(const std::string& name) {
    if (details_ != nullptr && name == "scale_text")
      details_->scale_text = fields_.text("sheet", name);
    else if (details_ != nullptr && name == "title")
      details_->title = fields_.text("sheet", name);
    else if (details_ != nullptr && name == "frame_paper_mm")
      details_->frame = read_frame(json_);
    else
      json_.skip();
  }

  void counts() {
    fields_.must_be(Kind::object, "the document", "counts", "object");
    json_.members([&](std::string_view key) {
      const std::string name(key);
      if (!counted_.emplace(name, fields_.count("counts", name)).second)
        throw contradiction("counts", "has \"" + name + "\" twice");
    });
  }

  void objects(const std::string& key, std::vector<ViewObject>& list) {
    fields_.must_be(Kind::array, "the document", key, "list");
    json_.items([&] {
      const std::string where = key + "[" + std::to_string(list.size()) + "]";
      if (json_.kind() != Kind::object) throw DocumentFault{where, "is no object"};
      ViewObject object;
      std::array<bool, 3> there{};
      json_.members([&](std::string_view field) {
        const std::string name(field);
        const auto take = [&](std::size_t i, std::string& into) {
          into = fields_.text(where, name);
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
      for (const auto& [i, field] :
           {std::pair(0, "id"), std::pair(1, "name"), std::pair(2, "file")})
        if (!there.at(static_cast<std::size_t>(i))) throw missing_key(where, field);
      list.push_back(std::move(object));
    });
  }

  void lines() {
    if (binary_) {
      rows_ = read_row_layout(json_);
      return;
    }
    fields_.must_be(Kind::array, "the document", "pieces", "list");
    const auto sink = [this](const ReadPiece& piece) { take(piece); };
    ViewPieceReader reader(json_, sink);
    json_.items([&] { reader.take(); });
  }

  void take(const ReadPiece& piece) {
    ++of_state_.at(static_cast<std::size_t>(piece.state));
    if (details_ != nullptr) return details_->add(piece, list_item());
    const auto rounded = [](const std::array<double, 2>& mm) {
      return std::array<float, 2>{static_cast<float>(mm[0]), static_cast<float>(mm[1])};
    };
    document_.pieces.push_back({piece.a, piece.b, rounded(piece.a_paper), rounded(piece.b_paper),
                                piece.object, piece.other, piece.kind, piece.state});
  }

  /// Returns what faults call a line before its number.
  [[nodiscard]] std::string_view list_item() const { return binary_ ? "row" : "piece"; }
  [[nodiscard]] std::string name_of(std::size_t line) const {
    return std::string(list_item()) + " " + std::to_string(line);
  }

  void check_curves() const {
    for (const hlr::CurvedEdge& edge : details_->curves.edges)
      if (edge.curve >= details_->curves.all.size())
        throw contradiction("the document", "has a line of curve " + std::to_string(edge.curve) +
                                                ", but there are " +
                                                std::to_string(details_->curves.all.size()));
  }

  void check_objects() const {
    std::set<std::pair<std::string_view, std::string_view>> ids;
    for (const ViewObject& object : document_.objects)
      if (!ids.emplace(object.file, object.id).second)
        throw contradiction("object '" + object.id + "' of '" + object.file + "'",
                            "stands there twice");
    const auto check_object = [this](std::size_t line, std::uint32_t object) {
      if (object >= document_.objects.size())
        throw contradiction(name_of(line), "is of object " + std::to_string(object) +
                                               ", but there are " +
                                               std::to_string(document_.objects.size()));
    };
    for (std::size_t p = 0; p < document_.pieces.size(); ++p)
      check_object(p, std::max(document_.pieces[p].object, document_.pieces[p].other));
    if (details_ == nullptr) return;
    for (std::size_t l = 0; l < details_->lines.size(); ++l)
      check_object(l, model::index(std::max(details_->lines[l].object, details_->lines[l].other)));
  }

  void check_counts() const {
    std::map<std::string, std::uint64_t> there;
    for (std::size_t s = 0; s < drawing::kLineStates; ++s)
      there[std::string(drawing::state_name(static_cast<drawing::LineState>(s)))] = of_state_.at(s);
    there["pieces"] = std::accumulate(of_state_.begin(), of_state_.end(), std::uint64_t{0});
    for (const auto& [key, count] : there)
      if (stated(key) != count)
        throw contradiction("the document", "counts " + std::to_string(stated(key)) + " of \"" +
                                                key + "\", but lists " + std::to_string(count));
  }

  [[nodiscard]] std::uint64_t stated(const std::string& key) const {
    const auto at = counted_.find(key);
    if (at == counted_.end()) throw missing_key("counts", key);
    return at->second;
  }

  JsonReader json_;
  DocumentFields fields_{json_};
  bool binary_;
  std::string lines_key_;
  ViewDocument& document_;
  ViewDetails* details_;
  std::array<std::uint64_t, drawing::kLineStates> of_state_{};
  std::set<std::string, std::less<>> met_;
  std::map<std::string, std::uint64_t> counted_;
  std::optional<RowLayout> rows_;
};

/// The first bytes of another stream, as a stream of their own, which adds them to a checksum: the
/// text of a binary document.
class FirstBytes : public std::streambuf {
 public:
  FirstBytes(std::istream& from, std::uint64_t size, Checksum& checksum)
      : from_(from), left_(size), checksum_(checksum) {}
  [[nodiscard]] std::uint64_t left() const { return left_; }

 private:
  int_type underflow() override {
    from_.read(buffer_.data(),
               static_cast<std::streamsize>(std::min<std::uint64_t>(left_, buffer_.size())));
    const std::streamsize got = from_.gcount();
    left_ -= static_cast<std::uint64_t>(got);
    checksum_.add({buffer_.data(), static_cast<std::size_t>(got)});
    setg(buffer_.data(), buffer_.data(), buffer_.data() + got);
    return got == 0 ? traits_type::eof() : traits_type::to_int_type(buffer_[0]);
  }

  std::istream& from_;
  std::uint64_t left_;
  Checksum& checksum_;
  std::array<char, 65536> buffer_{};
};

void read_binary(ViewDocument& document, ViewDetails* details, std::istream& in) {
  std::array<char, drawing::kViewMagic.size()> magic{};
  in.read(magic.data(), magic.size());
  if (std::string_view(magic.data(), magic.size()) != drawing::kViewMagic)
    throw DocumentFault{"the document", "is no drawing"};
  std::uint64_t size = 0;
  if (!in.read(reinterpret_cast<char*>(&size), sizeof size))
    throw contradiction("the document", "ends before its rows begin");
  Checksum checksum;
  checksum.add(drawing::kViewMagic);
  checksum.add({reinterpret_cast<const char*>(&size), sizeof size});
  FirstBytes first(in, size, checksum);
  std::istream text(&first);
  ViewDocumentReader reader(text, true, document, details);
  reader.read_text();
  if (first.left() > 0) throw contradiction("the document", "ends before its rows begin");
  reader.read_rows(in, checksum);
  reader.check();
}

void read_into(ViewDocument& document, ViewDetails* details, std::istream& in) {
  if (in.peek() == drawing::kViewMagic[0]) return read_binary(document, details, in);
  ViewDocumentReader reader(in, false, document, details);
  reader.read_text();
  reader.check();
}

Result<ViewDocument> parse(std::istream& in, const std::string& name, ViewDetails* details) {
  ViewDocument document;
  document.name = name;
  const Status status = read_guarded(name, kView, [&] { read_into(document, details, in); });
  if (!status) return status.error();
  return document;
}

}  // namespace

Result<ViewDocument> parse_view_document(std::istream& in, const std::string& name) {
  return parse(in, name, nullptr);
}

Result<ViewDocument> parse_view_document(std::istream& in, const std::string& name,
                                         ViewDetails& details) {
  return parse(in, name, &details);
}

Result<ViewDocument> read_view_document(const std::filesystem::path& file) {
  Result<std::ifstream> in = open_document(file);
  if (!in) return in.error();
  return parse_view_document(*in, file.string());
}

}  // namespace strake::report
