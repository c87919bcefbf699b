// SPDX-License-Identifier: Apache-2.0
#include "io/importer/scene_entry.hpp"

#include <sys/stat.h>

#include <charconv>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/checksum.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "io/importer/map_place.hpp"
#include "io/source/input_file.hpp"
#include "strake/core/hash.hpp"

namespace strake::io {
namespace {

constexpr std::string_view kMagic = "STRKSCN1";
/// The magic, two lengths and a hash of two words, the low byte of each first.
constexpr std::size_t kWord = 8, kFoot = 5 * kWord;
/// Facts are far shorter: messages of a code are kept up to a number, and codes are few.
constexpr std::uint64_t kMaxFacts = std::uint64_t{1} << 28U;

void append_word(std::string& out, std::uint64_t word) {
  for (std::size_t byte = 0; byte < kWord; ++byte, word >>= 8U)
    out.push_back(static_cast<char>(word & 0xffU));
}

std::uint64_t word_at(std::string_view text, std::size_t at) {
  std::uint64_t word = 0;
  for (std::size_t byte = kWord; byte-- > 0;)
    word = (word << 8U) | static_cast<unsigned char>(text[at + byte]);
  return word;
}

struct Foot {
  std::uint64_t scene = 0, facts = 0;  ///< lengths in bytes
  Hash128 hash;
};

/// Returns what the last bytes of an entry say, if it has so many bytes as that.
std::optional<Foot> read_foot(std::string_view foot, std::uint64_t entry_bytes) {
  if (foot.size() != kFoot || !foot.starts_with(kMagic)) return std::nullopt;
  const Foot read{word_at(foot, kWord),
                  word_at(foot, 2 * kWord),
                  {word_at(foot, 3 * kWord), word_at(foot, 4 * kWord)}};
  if (read.facts > kMaxFacts || read.facts > entry_bytes - kFoot ||
      read.scene != entry_bytes - kFoot - read.facts)
    return std::nullopt;
  return read;
}

/// Writes JSON value by value.
class FactsWriter {
 public:
  void key(std::string_view name) {
    separate();
    append_json_string(text_, name);
    text_ += ':';
    first_ = true;
  }
  void value(std::string_view text) {
    separate();
    append_json_string(text_, text);
  }
  void value(std::int64_t number) {
    separate();
    // As text: a number of JSON has 53 bits.
    append_json_string(text_, std::to_string(number));
  }
  void value(double number) {
    separate();
    append_shortest(text_, number);
  }
  void open(char bracket) {
    separate();
    text_ += bracket;
    first_ = true;
  }
  void close(char bracket) {
    text_ += bracket;
    first_ = false;
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void separate() {
    if (!std::exchange(first_, false)) text_ += ',';
  }
  std::string text_;
  bool first_ = true;
};

std::string facts_json(const EntryFacts& facts) {
  FactsWriter json;
  json.open('{');
  for (const auto& [name, text] : {std::pair{"file", &facts.file},
                                   {"made_by", &facts.scene.made_by},
                                   {"format", &facts.scene.format},
                                   {"unit", &facts.scene.unit}}) {
    json.key(name);
    json.value(*text);
  }
  if (const auto& map = facts.scene.map) {
    json.key("map");
    json.open('{');
    json.key("crs");
    json.value(map->crs);
    json.key("matrix");
    json.open('[');
    for (const double number : matrix_of(map->to_map)) json.value(number);
    json.close(']');
    json.close('}');
  }
  json.key("importer");
  json.open('[');
  for (const FileStamp& stamp : facts.importer) {
    json.open('[');
    json.value(stamp.path);
    json.value(stamp.size);
    json.value(stamp.time);
    json.close(']');
  }
  json.close(']');
  json.key("kept");
  json.open('[');
  for (const Diagnostic& one : facts.scene.diagnostics.kept()) {
    json.open('[');
    json.value(severity_name(one.severity));
    json.value(one.code);
    json.value(one.message);
    json.value(one.where);
    json.close(']');
  }
  json.close(']');
  json.key("counts");
  json.open('[');
  for (const Diagnostics::Count& count : facts.scene.diagnostics.counts()) {
    json.open('[');
    json.value(count.code);
    json.value(static_cast<std::int64_t>(count.count));
    json.close(']');
  }
  json.close(']');
  json.close('}');
  return json.take();
}

std::int64_t number_in(const gltf::JsonValue& value) {
  std::int64_t number = 0;
  const std::string text = value.text_value();
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() ? number : 0;
}

Diagnostics diagnostics_in(const gltf::JsonValue& root) {
  Diagnostics read;
  root["kept"].elements([&](const gltf::JsonValue& one) {
    const std::vector<gltf::JsonValue> parts = one.items();
    if (parts.size() != 4) return;
    for (const Severity severity : {Severity::note, Severity::warning, Severity::skipped})
      if (parts[0].is_text(severity_name(severity)))
        read.add(severity, parts[1].text_value(), parts[2].text_value(), parts[3].text_value());
  });
  root["counts"].elements([&](const gltf::JsonValue& one) {
    const std::vector<gltf::JsonValue> parts = one.items();
    if (parts.size() != 2) return;
    const auto count = static_cast<std::uint64_t>(number_in(parts[1]));
    if (count > Diagnostics::kMaxPerCode)
      read.count_more(parts[0].text_value(), count - Diagnostics::kMaxPerCode);
  });
  return read;
}

std::optional<EntryFacts> parse_facts(std::string_view text) {
  const Result<gltf::JsonDocument> document = gltf::JsonDocument::parse(text);
  if (!document || !document->root().is_object()) return std::nullopt;
  const gltf::JsonValue root = document->root();
  EntryFacts facts;
  facts.file = root["file"].text_value();
  facts.scene.made_by = root["made_by"].text_value();
  facts.scene.format = root["format"].text_value();
  facts.scene.unit = root["unit"].text_value();
  facts.scene.map = map_place_in(root["map"]);
  root["importer"].elements([&](const gltf::JsonValue& stamp) {
    const std::vector<gltf::JsonValue> parts = stamp.items();
    if (parts.size() == 3)
      facts.importer.push_back({parts[0].text_value(), number_in(parts[1]), number_in(parts[2])});
  });
  facts.scene.diagnostics = diagnostics_in(root);
  return facts;
}

}  // namespace

FileStamp stamp_of(const std::filesystem::path& file) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  FileStamp stamp{file.string(), -1, 0};
  struct stat facts{};
  if (::stat(file.c_str(), &facts) != 0) return stamp;
  stamp.size = facts.st_size;
  stamp.time = facts.st_mtim.tv_sec * kNanoseconds + facts.st_mtim.tv_nsec;
  return stamp;
}

std::string entry_trailer(std::span<const std::byte> scene, const EntryFacts& facts) {
  std::string trailer = facts_json(facts);
  const std::uint64_t size = trailer.size();
  Checksum checksum;
  checksum.add(as_text(scene));
  checksum.add(trailer);
  trailer += kMagic;
  append_word(trailer, scene.size());
  append_word(trailer, size);
  append_word(trailer, checksum.value().high);
  append_word(trailer, checksum.value().low);
  return trailer;
}

std::optional<EntryFacts> read_entry_facts(const std::filesystem::path& file) {
  // A pipe in its place would be waited for.
  std::error_code failed;
  if (std::filesystem::symlink_status(file, failed).type() != std::filesystem::file_type::regular)
    return std::nullopt;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff bytes = in.tellg();
  if (!in || bytes < static_cast<std::streamoff>(kFoot)) return std::nullopt;
  std::string text(kFoot, '\0');
  in.seekg(bytes - static_cast<std::streamoff>(kFoot));
  in.read(text.data(), kFoot);
  if (!in) return std::nullopt;
  const std::optional<Foot> foot = read_foot(text, static_cast<std::uint64_t>(bytes));
  if (!foot) return std::nullopt;
  text.resize(foot->facts);
  in.seekg(static_cast<std::streamoff>(foot->scene));
  in.read(text.data(), static_cast<std::streamsize>(foot->facts));
  if (!in) return std::nullopt;
  return parse_facts(text);
}

std::optional<std::span<const std::byte>> scene_in(std::span<const std::byte> entry) {
  if (entry.size() < kFoot) return std::nullopt;
  const std::size_t body = entry.size() - kFoot;
  const std::optional<Foot> foot = read_foot(as_text(entry.subspan(body)), entry.size());
  if (!foot || hash_bytes(entry.first(body)) != foot->hash) return std::nullopt;
  return entry.first(static_cast<std::size_t>(foot->scene));
}

}  // namespace strake::io
