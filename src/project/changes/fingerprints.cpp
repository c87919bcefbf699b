// SPDX-License-Identifier: Apache-2.0
#include "project/changes/fingerprints.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "geometry/primitives/lengths.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

/// Values in a row, to be hashed at once: a Hasher for each of a million objects takes longer.
class HashedRow {
 public:
  void clear() { bytes_.clear(); }
  void add(std::uint64_t value) { append(&value, sizeof value); }
  /// There is one zero.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  void add(const Hash128& hash) {
    add(hash.high);
    add(hash.low);
  }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    bytes_ += text;
  }
  [[nodiscard]] Hash128 hash() const { return hash_bytes(std::as_bytes(std::span(bytes_))); }

 private:
  void append(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  std::string bytes_;
};

void add(HashedRow& row, const model::Attributes& attributes) {
  row.add(std::uint64_t{attributes.size()});
  for (const auto& [name, value] : attributes) {
    row.add(std::string_view(name));
    row.add(std::string_view(value));
  }
}

template <class T>
void add_bytes(Hasher& hasher, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  hasher.add(std::as_bytes(std::span(values)));
}

struct ShapeFingerprint {
  Hash128 operator()(const geometry::TriangleMesh& mesh) const {
    Hasher hasher;
    hasher.add(std::string_view("mesh"));
    add_bytes(hasher, mesh.vertices);
    add_bytes(hasher, mesh.triangles);
    add_bytes(hasher, mesh.faces);
    return hasher.add(mesh.sag_mm).value();
  }
  Hash128 operator()(const geometry::Polylines& lines) const {
    Hasher hasher;
    hasher.add(std::string_view("polylines"));
    add_bytes(hasher, lines.points);
    add_bytes(hasher, lines.first);
    return hasher.value();
  }
  Hash128 operator()(const geometry::Primitive& primitive) const {
    Hasher hasher;
    hasher.add(geometry::kind_name(primitive));
    std::visit(
        [&](const auto& kind) {
          for (const double length : geometry::lengths_of(kind)) hasher.add(length);
        },
        primitive);
    return hasher.value();
  }
};

/// What a group hands down to the objects below.
struct InheritedHashes {
  Hash128 path, facts;
};

/// Works out what groups hand down: those above first. A group that is above itself hands down as
/// if it were outermost.
class Inheritance {
 public:
  explicit Inheritance(const model::Model& model) : model_(model), of_(model.groups.size()) {
    std::vector<State> states(of_.size(), State::open);
    std::vector<std::uint32_t> chain;
    for (std::uint32_t g = 0; g < of_.size(); ++g) {
      for (std::uint32_t at = g; at < of_.size() && states[at] == State::open;
           at = model::index(model.groups[at].parent)) {
        states[at] = State::begun;
        chain.push_back(at);
      }
      for (; !chain.empty(); chain.pop_back()) {
        work_out(chain.back(), states);
        states[chain.back()] = State::done;
      }
    }
  }

  [[nodiscard]] InheritedHashes of(model::GroupId group) const {
    return model::index(group) < of_.size() ? of_[model::index(group)] : InheritedHashes{};
  }

 private:
  enum class State : std::uint8_t { open, begun, done };

  void work_out(std::uint32_t g, const std::vector<State>& states) {
    const model::Group& group = model_.groups[g];
    const std::uint32_t parent = model::index(group.parent);
    const bool has_parent = parent < of_.size() && states[parent] == State::done;
    const InheritedHashes above = has_parent ? of_[parent] : InheritedHashes{};
    row_.clear();
    row_.add(above.path);
    row_.add(std::string_view(group.name));
    of_[g].path = row_.hash();
    of_[g].facts = above.facts;
    if (group.attributes >= model_.group_attributes.size()) return;
    row_.clear();
    row_.add(above.facts);
    add(row_, model_.group_attributes[group.attributes]);
    of_[g].facts = row_.hash();
  }

  const model::Model& model_;
  std::vector<InheritedHashes> of_;
  HashedRow row_;
};

/// Makes fingerprints of one object after the other.
class Fingerprinter {
 public:
  Fingerprinter(const model::Model& model, const std::vector<Hash128>& shapes,
                const Inheritance& inheritance)
      : model_(&model), shapes_(&shapes), inheritance_(&inheritance) {}

  Fingerprint of(const model::Object& object) {
    const auto bodies =
        std::span(model_->bodies).subspan(object.first_body, std::size_t{object.body_count});
    const InheritedHashes inherited = inheritance_->of(object.parent);
    Fingerprint print;
    print.shapes = hash_of([&] {
      row_.add(std::uint64_t{object.incomplete});
      for (const model::Body& body : bodies) row_.add((*shapes_)[model::index(body.shape)]);
    });
    print.places = hash_of([&] {
      for (const model::Body& body : bodies) add(body.placement);
    });
    paints_.clear();
    for (const model::Body& body : bodies) paints_.push_back(paint_of(body));
    print.paints = hash_of([&] { add_paints(); });
    std::ranges::sort(paints_);
    paints_.erase(std::ranges::unique(paints_).begin(), paints_.end());
    print.appearance = hash_of([&] { add_paints(); });
    print.naming = hash_of([&] {
      row_.add(std::string_view(object.name));
      row_.add(inherited.path);
    });
    print.facts = hash_of([&] {
      project::add(row_, object.attributes);
      row_.add(inherited.facts);
    });
    return print;
  }

 private:
  template <class Fill>
  Hash128 hash_of(const Fill& fill) {
    row_.clear();
    fill();
    return row_.hash();
  }

  static std::uint64_t paint_of(const model::Body& body) {
    const model::Color& c = body.color;
    return std::uint64_t{c.red} << 24U | std::uint64_t{c.green} << 16U |
           std::uint64_t{c.blue} << 8U | std::uint64_t{c.alpha} |
           static_cast<std::uint64_t>(body.category) << 32U;
  }

  void add_paints() {
    for (const std::uint64_t paint : paints_) row_.add(paint);
  }

  void add(const geometry::Placement& placement) {
    for (const geometry::Vec3d& row : placement.linear.row)
      for (int k = 0; k < 3; ++k) row_.add(row[k]);
    for (int k = 0; k < 3; ++k) row_.add(placement.translation[k]);
  }

  const model::Model* model_;
  const std::vector<Hash128>* shapes_;
  const Inheritance* inheritance_;
  HashedRow row_;
  std::vector<std::uint64_t> paints_;
};

}  // namespace

Result<std::vector<Fingerprint>> fingerprints(const model::Model& model,
                                              const parallel::Context& context) {
  const Result<std::vector<Hash128>> shapes = parallel::transform(
      context, {.name = "hashes of shapes", .n = model.shapes.size(), .grain = 16},
      [&](std::size_t s) { return std::visit(ShapeFingerprint(), model.shapes[s]); });
  if (!shapes) return shapes.error();
  const Inheritance inheritance(model);
  return parallel::transform_with(
      context, {.name = "hashes of objects", .n = model.objects.size(), .grain = 256},
      [&] { return Fingerprinter(model, *shapes, inheritance); },
      [&](Fingerprinter& fingerprinter, std::size_t o) {
        return fingerprinter.of(model.objects[o]);
      });
}

}  // namespace strake::project
