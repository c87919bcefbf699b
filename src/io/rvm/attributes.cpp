// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "core/seeded_hash.hpp"
#include "core/text_encoding.hpp"
#include "io/source/input_file.hpp"
#include "io/source/text_number.hpp"

namespace strake::io::rvm {

namespace {

std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return trimmed(line, kLineBlanks);
}

/// The words that structure the file, as its first line declares them.
struct Tokens {
  std::string_view start = "NEW", end = "END", name_end = ":=", separator = "&end&";
};

std::optional<Tokens> parse_first_line(std::string_view line) {
  if (line.find("Attributes_File") == std::string_view::npos) return std::nullopt;
  Tokens tokens;
  while (!line.empty()) {
    const std::size_t comma = std::min(line.find(','), line.size());
    const std::string_view field = line.substr(0, comma);
    line.remove_prefix(std::min(comma + 1, line.size()));
    const std::size_t colon = field.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view key = trimmed(field.substr(0, colon), kLineBlanks);
    const std::string_view value = trimmed(field.substr(colon + 1), kLineBlanks);
    if (value.empty()) continue;
    if (key == "start") tokens.start = value;
    if (key == "end") tokens.end = value;
    if (key == "name_end") tokens.name_end = value;
    if (key == "sep") tokens.separator = value;
  }
  return tokens;
}

std::string_view unquoted(std::string_view value) {
  if (value.size() >= 2 && (value.front() == '\'' || value.front() == '"') &&
      value.back() == value.front())
    return value.substr(1, value.size() - 2);
  return value;
}

class AttributeParser {
 public:
  explicit AttributeParser(const Tokens& tokens) : tokens_(tokens) {}

  void line(std::string_view line) {
    if (line.empty()) return;
    if (line == tokens_.end) {
      if (!open_.empty()) open_.pop_back();
    } else if (const auto name = started(line)) {
      const bool header = file_.nodes.empty() && !has_header_ && *name == "Header Information";
      has_header_ = true;
      const std::uint32_t parent = open_.empty() ? kNoGroup : open_.back();
      if (header) {
        open_.push_back(kNoGroup);
        return;
      }
      open_.push_back(static_cast<std::uint32_t>(file_.nodes.size()));
      file_.nodes.push_back({*name, parent, {}});
    } else {
      values(line);
    }
  }
  [[nodiscard]] AttributeFile take() {
    file_.ends_early = !open_.empty();
    return std::move(file_);
  }

 private:
  [[nodiscard]] std::optional<std::string_view> started(std::string_view line) const {
    if (!line.starts_with(tokens_.start)) return std::nullopt;
    line.remove_prefix(tokens_.start.size());
    if (!line.empty() && line.front() != ' ' && line.front() != '\t') return std::nullopt;
    if (line.find(tokens_.name_end) != std::string_view::npos) return std::nullopt;
    return trimmed(line, kLineBlanks);
  }

  void values(std::string_view line) {
    bool any = false;
    while (!line.empty()) {
      const std::size_t end = std::min(line.find(tokens_.separator), line.size());
      const std::string_view entry = line.substr(0, end);
      line.remove_prefix(std::min(end + tokens_.separator.size(), line.size()));
      const std::size_t split = entry.find(tokens_.name_end);
      if (split == std::string_view::npos) continue;
      any = true;
      // Outside any element, or inside the header block: nobody's attributes.
      if (open_.empty() || open_.back() == kNoGroup) continue;
      file_.nodes[open_.back()].values.emplace_back(
          trimmed(entry.substr(0, split), kLineBlanks),
          unquoted(trimmed(entry.substr(split + tokens_.name_end.size()), kLineBlanks)));
    }
    if (!any) ++file_.unreadable_lines;
  }

  Tokens tokens_;
  AttributeFile file_;
  std::vector<std::uint32_t> open_;
  bool has_header_ = false;
};

/// Indexes children of one parent by name; a name that occurs twice among them is ambiguous.
class NameIndex {
 public:
  static constexpr std::uint32_t kAmbiguous = 0xfffffffeU;

  void add(std::string name, std::uint32_t node) {
    const auto [at, added] = nodes_.emplace(std::move(name), node);
    if (!added) at->second = kAmbiguous;
  }
  [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) const {
    const auto at = nodes_.find(name);
    if (at == nodes_.end() || at->second == kAmbiguous) return std::nullopt;
    return at->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t, SeededHash> nodes_;
};

std::string keyed(std::uint32_t parent, std::string_view name) {
  return fmt::format("{}\n{}", parent, name);
}

/// Returns which attribute node each group is, kNoGroup for none.
std::vector<std::uint32_t> match(const RvmModel& built, const std::vector<std::string>& names,
                                 const AttributeFile& file) {
  NameIndex by_path, by_name, groups;
  for (std::uint32_t n = 0; n < file.nodes.size(); ++n) {
    by_path.add(keyed(file.nodes[n].parent, names[n]), n);
    by_name.add(names[n], n);
  }
  for (std::uint32_t g = 0; g < built.groups.size(); ++g) groups.add(built.model.groups[g].name, g);
  std::vector<std::uint32_t> matched(built.groups.size(), kNoGroup);
  for (std::uint32_t g = 0; g < built.groups.size(); ++g) {
    const std::string& name = built.model.groups[g].name;
    if (name.empty()) continue;
    const std::uint32_t parent = built.groups[g].parent;
    const bool parent_matched = parent == kNoGroup || matched[parent] != kNoGroup;
    std::optional<std::uint32_t> node;
    if (parent_matched)
      node = by_path.find(keyed(parent == kNoGroup ? kNoGroup : matched[parent], name));
    if (!node && groups.find(name)) node = by_name.find(name);
    matched[g] = node.value_or(kNoGroup);
  }
  return matched;
}

}  // namespace

Result<AttributeFile> parse_attributes(std::string_view text) {
  text = without_byte_order_mark(text);
  std::string_view first;
  while (!text.empty() && first.empty()) first = next_line(text);
  const auto tokens = parse_first_line(first);
  if (!tokens) {
    const bool listing = first.find("Data Listing") != std::string_view::npos;
    return Error{ErrorCode::input,
                 listing ? "this is a report listing, not an attribute file"
                         : "the first line is not that of an attribute file",
                 "", "export the attributes with the model (CADC_Attributes_File)"};
  }
  AttributeParser parser(*tokens);
  while (!text.empty()) parser.line(next_line(text));
  return parser.take();
}

std::optional<std::filesystem::path> find_attribute_file(const std::filesystem::path& model_path) {
  namespace fs = std::filesystem;
  if (model_path.empty()) return std::nullopt;
  const fs::path folder = model_path.has_parent_path() ? model_path.parent_path() : fs::path(".");
  const std::string stem = lowered(model_path.stem().string());
  std::vector<std::pair<int, fs::path>> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path& path = at->path();
    const std::string extension = lowered(path.extension().string());
    if (extension != ".att" && extension != ".txt") continue;
    if (lowered(path.stem().string()) != stem || path.filename() == model_path.filename()) continue;
    found.emplace_back(extension == ".att" ? 0 : 1, path);
  }
  if (found.empty()) return std::nullopt;
  return std::min_element(found.begin(), found.end())->second;
}

void attach_attributes(RvmModel& built, const AttributeFile& file, const TextDecoder& decode,
                       std::string_view where, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  names.reserve(file.nodes.size());
  for (const AttributeNode& node : file.nodes) names.push_back(decode(node.name));
  const std::vector<std::uint32_t> matched = match(built, names, file);
  const auto attributes_of = [&](std::uint32_t group) {
    model::Attributes attributes;
    if (group == kNoGroup || matched[group] == kNoGroup) return attributes;
    const auto& values = file.nodes[matched[group]].values;
    attributes.reserve(values.size());
    for (const auto& [key, value] : values) attributes.emplace_back(decode(key), decode(value));
    return attributes;
  };
  for (std::size_t o = 0; o < built.model.objects.size(); ++o)
    built.model.objects[o].attributes = attributes_of(built.group_of[o]);
  std::vector<bool> has_heirs(built.groups.size(), false);
  for (const GroupRecord& group : built.groups)
    if (group.parent != kNoGroup) has_heirs[group.parent] = true;
  for (std::uint32_t g = 0; g < built.groups.size(); ++g)
    if (has_heirs[g]) built.model.set_attributes(model::GroupId{g}, attributes_of(g));
  std::vector<bool> used(file.nodes.size(), false);
  std::size_t bare = 0;
  for (const std::uint32_t node : matched) {
    if (node == kNoGroup)
      ++bare;
    else
      used[node] = true;
  }
  const auto unused = std::count(used.begin(), used.end(), false);
  diagnostics.add(Severity::note, "rvm-attributes-matched",
                  fmt::format("{} of {} groups have attributes; {} of {} attribute records belong "
                              "to no group of the model",
                              matched.size() - bare, matched.size(), unused, used.size()),
                  std::string(where));
  if (file.unreadable_lines > 0)
    diagnostics.add(
        Severity::warning, "rvm-attribute-lines",
        fmt::format("{} lines are neither a block nor an attribute", file.unreadable_lines),
        std::string(where));
  if (file.ends_early)
    diagnostics.add(Severity::warning, "rvm-attributes-truncated",
                    "the file ends within an element: what it said of that and of what follows is "
                    "unknown",
                    std::string(where));
}

std::string reference_of(const model::Attributes& attributes) {
  const auto usable = [](const std::string& value) {
    return value.size() > 1 && value.front() == '=' && value != "=0/0";
  };
  for (const auto& [key, value] : attributes)
    if (key == "RefNo" && usable(value)) return value;
  for (const auto& [key, value] : attributes)
    if (key == "Name" && usable(value)) return value;
  return {};
}

}  // namespace strake::io::rvm
