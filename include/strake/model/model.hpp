// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

enum class ShapeId : std::uint32_t {};
enum class ObjectId : std::uint32_t {};
enum class GroupId : std::uint32_t { none = 0xffffffffU };

template <class Id>
[[nodiscard]] constexpr std::uint32_t index(Id id) {
  return static_cast<std::uint32_t>(id);
}

/// No object's number. In what maps the objects of one state of a model to those of another it
/// stands for one that is not there, or is not what it was.
inline constexpr std::uint32_t kNoObject = 0xffffffffU;

/// Geometry in its own frame (millimetres, z up), shared by every body that places it.
using Shape = std::variant<geometry::TriangleMesh, geometry::Primitive, geometry::Polylines>;

struct Color {
  std::uint8_t red = 170, green = 170, blue = 170;
  std::uint8_t alpha = 255;  ///< below 255 is transparent: it hides nothing
  friend bool operator==(const Color&, const Color&) = default;
};

/// Returns "box", "cylinder" … for primitives, "mesh" or "polylines".
[[nodiscard]] std::string_view kind_name(const Shape& shape);

/// What a body stands for in the source system.
enum class Category : std::uint8_t {
  physical,
  obstruction,  ///< space kept free for access or maintenance (RVM OBST)
  insulation,   ///< RVM INSU
};

/// One placed shape of an object.
struct Body {
  ShapeId shape{};
  /// Half the spacing of the numbers that the source has for this body, µm, from which its contact
  /// distance is derived. 0: they are exact. (A float fills a gap that would be empty.)
  float precision_um = 0;
  geometry::Placement placement;  ///< from local mm to world mm, z up
  Color color;
  Category category = Category::physical;
};

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// A node of the source's hierarchy that is not itself an object (or also is one).
struct Group {
  static constexpr std::uint32_t kNoAttributes = 0xffffffffU;

  std::string name;
  GroupId parent = GroupId::none;
  std::uint32_t attributes = kNoAttributes;  ///< index into Model::group_attributes
};

/// What a user would point at: an RVM group that directly holds primitives, a glTF node with a
/// mesh, an OBJ o/g group, an STL or PLY file.
struct Object {
  /// A durable id, which stays the same while the source element does, unless `positional_id`. It
  /// is unique within its file.
  std::string id;
  std::string name;
  std::uint32_t file = 0;          ///< index into Model::files
  GroupId parent = GroupId::none;  ///< the group above; following parents ends at the outermost
  std::uint32_t first_body = 0;    ///< bodies [first_body, first_body + body_count)
  std::uint32_t body_count = 0;
  std::uint32_t place = 0;  ///< its number in the order of the source, over the model
  Attributes attributes;    ///< its own; Model::stated() has what it inherits
  /// The source has geometry of it that could not be read; if it has no bodies, none could.
  bool incomplete = false;
  /// The source gives it no lasting name: its id counts elements of the file, and becomes another
  /// element's when one is inserted before it.
  bool positional_id = false;
};

/// Where a part of the model came from.
struct SourceFile {
  /// What results call the file: its name, with as many folders as tell it from its namesakes.
  std::string label;
  std::string format;   ///< "RVM 2", "GLB", "OBJ", "STL binary" …
  std::string unit;     ///< the length unit applied, "mm" …, and whether stated, assumed or given
  std::string up_axis;  ///< "z", "y", …
  std::uint64_t bytes = 0;
  /// Half the spacing of the source's numbers, in mm: that of the worst of its bodies.
  double precision_mm = 0;
  std::string folders =
      {};  ///< that it lies in, the outermost first, a '/' behind each; empty: not known
  bool ends_early = false;  ///< it was cut off, and what the rest held is not known
};

/// Objects read from one or several files, as the sources describe them (doubles, not yet on the
/// grid; see Scene for that).
///
/// Objects are ordered by (file label, id) once `finish` has run, so that ObjectId order is the
/// durable order of results and does not depend on the order in which files were given.
struct Model {
  std::vector<SourceFile> files;
  std::vector<Group> groups;
  /// What groups state, kept once for all objects below.
  std::vector<Attributes> group_attributes;
  std::vector<Shape> shapes;
  std::vector<Object> objects;
  std::vector<Body> bodies;
  Diagnostics diagnostics;

  [[nodiscard]] const Object& object(ObjectId id) const { return objects[index(id)]; }
  /// Returns names from the outermost group to the object's own parent; they last as long as the
  /// groups.
  [[nodiscard]] std::vector<std::string_view> group_names(const Object& object) const;
  /// Returns the group names as a path.
  [[nodiscard]] std::string path(const Object& object) const;

  /// Where an attribute of an object is stated.
  struct Stated {
    const Attributes* attributes = nullptr;  ///< null: nowhere
    GroupId group = GroupId::none;           ///< none: by the object itself
  };
  /// Returns where an attribute is stated: an object inherits what it does not state itself from
  /// the nearest group above that does.
  [[nodiscard]] Stated stated(const Object& object, std::string_view attribute) const;
  /// Gives a group attributes, if there are any.
  void set_attributes(GroupId group, Attributes attributes);
};

/// Returns what is not known of files that end early: "the rest of a.rvm, which ends early", for
/// several files "the rest of a.rvm and 2 more files, which end early". It is empty where all are
/// whole.
[[nodiscard]] std::string unread_rest(const Model& model);

/// Joins names by '/'. A name that begins with '/', as full names of RVM do, brings it along:
/// "/SITE" and "/ZONE" become "/SITE/ZONE".
[[nodiscard]] std::string joined_path(std::span<const std::string_view> names);

/// Makes file labels and object ids unique (a repeated id gains "#2", "#3", … and a diagnostic, and
/// all that share it have positional ids), counts positional ids, sets the objects' places, and
/// orders objects by (file label, id) and bodies by object. What a reader returns is not a finished
/// Model until this ran; io::read_models() calls it.
/// All workers sort. Errors: cancelled, out of memory; then the model is of no use.
[[nodiscard]] Status finish(Model& model, const parallel::Context& context);
/// The same by the calling thread alone.
void finish(Model& model);

/// Takes a model down by all workers, which for a million objects takes one as long as a twentieth
/// of reading them. Nothing is left in it.
void clear(Model& model, const parallel::Context& context);

/// Appends the files, groups, shapes, objects, bodies and diagnostics of `other`.
void append(Model& model, Model&& other);

/// Joins finished models into one, which is finished as if its files had been read at once: labels
/// that repeat gain folders.
[[nodiscard]] Model join(std::span<Model> models);

}  // namespace strake::model
