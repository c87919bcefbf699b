// SPDX-License-Identifier: Apache-2.0
#include "scene_model.hpp"

#include <BRep_Builder.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDF_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFPrs.hxx>
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "labels.hpp"
#include "product_pieces.hpp"

namespace strake::import_step {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// A file of a few lines can place a part that many times.
constexpr std::size_t kMaxObjects = 5'000'000;

Placement placement_of(const TopLoc_Location& location) {
  const gp_Trsf& place = location.Transformation();
  Placement result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result.linear.row[static_cast<std::size_t>(row)][column] = place.Value(row + 1, column + 1);
  result.translation = {place.Value(1, 4), place.Value(2, 4), place.Value(3, 4)};
  return result;
}

/// Gives an attribute a value, in place of the one that it has.
void state(model::Attributes& attributes, const std::string& name, std::string value) {
  std::erase_if(attributes, [&](const auto& one) { return one.first == name; });
  attributes.emplace_back(name, std::move(value));
}

/// A product made into shapes of the model, which count from its middle.
struct Product {
  struct Part {
    model::ShapeId shape{};
    std::optional<model::Color> color;
    std::string name;
  };
  std::string name;
  std::vector<Part> parts;
  Vec3d middle;
  model::Attributes attributes;
};

/// Names within a group: of several that are equal the second is "bolt~2".
class NameCounter {
 public:
  std::string unique(const std::string& name) {
    const std::size_t count = ++counts_[name];
    if (count == 1) return name;
    const std::string next = name + "~" + std::to_string(count);
    if (counts_.contains(next)) return unique(next);
    ++counts_[next];
    return next;
  }

 private:
  std::map<std::string, std::size_t> counts_;
};

class SceneBuilder {
 public:
  SceneBuilder(const Document& document, const SceneOptions& options, Report& report,
               const Handle(ReportProgress) & progress)
      : document_(document),
        options_(options),
        report_(report),
        progress_(progress),
        labels_(document.content) {}
  Result<model::Model> build();

 private:
  /// Where something is in the tree of assemblies.
  struct Place {
    TopLoc_Location location;
    model::GroupId group = model::GroupId::none;
    std::string id;                     ///< of what it is in, '/' at the end
    std::optional<model::Color> color;  ///< of the assembly
    std::vector<TDF_Label> instances;   ///< that lead there, the outermost first
  };

  void count_products(const TDF_Label& label, std::set<std::string>& visited);
  void add_tree(const TDF_Label& label, const TDF_Label& instance, const Place& place,
                NameCounter& names);
  void add_instance(const Product& product, const TDF_Label& instance, const Place& place,
                    NameCounter& names);
  void add_separately(const Product& product, const Place& place, NameCounter& names);
  void add_roots();
  void add_loose_surfaces(const std::vector<TDF_Label>& roots, NameCounter& names);
  model::GroupId add_group(const std::string& name, model::GroupId parent);
  const Product& product_of(const TDF_Label& label);
  Product make_product(std::string name, const TopoDS_Shape& shape,
                       const XCAFPrs_IndexedDataMapOfShapeStyle& styles);
  void add_part(Product& product, const Piece& piece, std::vector<model::Shape>& shapes);
  void center(Product& product, std::vector<model::Shape>& shapes);
  void report_left_out();

  const Document& document_;
  const SceneOptions& options_;
  Report& report_;
  Handle(ReportProgress) progress_;
  Labels labels_;
  model::Model model_;
  std::map<std::string, Product> products_;  ///< by the entry of their label
  std::size_t product_count_ = 0, products_made_ = 0;
  std::size_t curves_ = 0, without_shape_ = 0;
  bool too_many_ = false;
};

std::string entry_of(const TDF_Label& label) {
  TCollection_AsciiString entry;
  TDF_Tool::Entry(label, entry);
  return entry.ToCString();
}

/// Whether a label has parts that are objects of their own.
bool is_assembly(const TDF_Label& label) {
  return XCAFDoc_ShapeTool::IsAssembly(label) && !Labels::is_product_in_pieces(label);
}

TDF_Label referred(const TDF_Label& label) {
  TDF_Label product = label;
  XCAFDoc_ShapeTool::GetReferredShape(label, product);
  return product;
}

void SceneBuilder::count_products(const TDF_Label& label, std::set<std::string>& visited) {
  if (!visited.insert(entry_of(label)).second) return;
  if (!is_assembly(label)) {
    ++product_count_;
    return;
  }
  TDF_LabelSequence components;
  XCAFDoc_ShapeTool::GetComponents(label, components);
  for (const TDF_Label& component : components) count_products(referred(component), visited);
}

model::GroupId SceneBuilder::add_group(const std::string& name, model::GroupId parent) {
  const auto group = static_cast<model::GroupId>(model_.groups.size());
  model_.groups.push_back({name, parent});
  model_.set_attributes(group, {{"Assembly", name}});
  return group;
}

void SceneBuilder::add_part(Product& product, const Piece& piece,
                            std::vector<model::Shape>& shapes) {
  MeshedPiece meshed = mesh_piece(piece, options_.mesh, progress_);
  const std::string name = product.name.empty() ? options_.file_name : product.name;
  if (!meshed.fault.empty()) {
    report_.add(Severity::skipped, "step-no-triangles", name,
                std::string(piece.is_solid ? "a solid" : "a surface") +
                    " of the product is not in the scene: " + meshed.fault);
    return;
  }
  if (meshed.faces_without > 0)
    report_.add(Severity::skipped, "step-face-without-triangles", name,
                std::to_string(meshed.faces_without) + " faces have no triangles");
  if (piece.is_solid && !meshed.is_closed)
    report_.add(Severity::warning, "step-open-solid", name,
                "its faces do not meet everywhere, so that it counts as a surface");
  if (meshed.coarser_sag_mm)
    report_.add(Severity::note, "step-coarse", name,
                "its triangles may lie " + std::to_string(*meshed.coarser_sag_mm) +
                    " mm from the true surface, more than was asked for");
  const TDF_Label label = labels_.shapes->FindShape(piece.shape);
  product.parts.push_back({static_cast<model::ShapeId>(model_.shapes.size() + shapes.size()),
                           piece.color, Labels::name_of(label)});
  shapes.emplace_back(std::move(meshed.mesh));
}

/// Has corners count from the middle of the product: they are written as float32.
void SceneBuilder::center(Product& product, std::vector<model::Shape>& shapes) {
  constexpr double kMax = 1e300;
  Vec3d low{kMax, kMax, kMax}, high{-kMax, -kMax, -kMax};
  for (const model::Shape& shape : shapes)
    for (const Vec3d& v : std::get<geometry::TriangleMesh>(shape).vertices)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], v[k]);
        high[k] = std::max(high[k], v[k]);
      }
  product.middle = (low + high) * 0.5;
  for (model::Shape& shape : shapes)
    for (Vec3d& v : std::get<geometry::TriangleMesh>(shape).vertices) v = v - product.middle;
}

Product SceneBuilder::make_product(std::string name, const TopoDS_Shape& shape,
                                   const XCAFPrs_IndexedDataMapOfShapeStyle& styles) {
  constexpr double kFrom = 0.5, kTo = 0.95;
  Product product;
  product.name = std::move(name);
  const Pieces pieces = pieces_of(shape, styles);
  curves_ += pieces.curves;
  if (pieces.pieces.empty()) ++without_shape_;
  std::vector<model::Shape> shapes;
  const auto part_done = [&](std::size_t piece) {
    const double within = static_cast<double>(piece) /
                          static_cast<double>(std::max<std::size_t>(1, pieces.pieces.size()));
    return kFrom + (kTo - kFrom) * (static_cast<double>(products_made_) + within) /
                       static_cast<double>(std::max<std::size_t>(1, product_count_));
  };
  for (std::size_t i = 0; i < pieces.pieces.size(); ++i) {
    progress_->next(part_done(i), part_done(i + 1), options_.mesh.limit_s);
    add_part(product, pieces.pieces[i], shapes);
  }
  ++products_made_;
  if (!shapes.empty()) center(product, shapes);
  for (model::Shape& one : shapes) model_.shapes.push_back(std::move(one));
  return product;
}

const Product& SceneBuilder::product_of(const TDF_Label& label) {
  const std::string entry = entry_of(label);
  if (const auto known = products_.find(entry); known != products_.end()) return known->second;
  XCAFPrs_IndexedDataMapOfShapeStyle styles;
  XCAFPrs::CollectStyleSettings(label, TopLoc_Location(), styles);
  Product product =
      make_product(Labels::name_of(label), XCAFDoc_ShapeTool::GetShape(label), styles);
  if (!product.name.empty()) product.attributes.emplace_back("Product", product.name);
  if (std::string layers = labels_.layers_of(label); !layers.empty())
    product.attributes.emplace_back("Layer", std::move(layers));
  if (std::string material = Labels::material_of(label); !material.empty())
    product.attributes.emplace_back("Material", std::move(material));
  return products_.emplace(entry, std::move(product)).first->second;
}

/// Adds an object that has all parts of a product.
void SceneBuilder::add_instance(const Product& product, const TDF_Label& instance,
                                const Place& place, NameCounter& names) {
  if (product.parts.empty()) return;
  if (model_.objects.size() >= kMaxObjects) {
    too_many_ = true;
    return;
  }
  const std::string own = Labels::instance_name(instance, product.name);
  model::Object object;
  object.name = !own.empty() ? own : !product.name.empty() ? product.name : options_.file_name;
  object.id = place.id + names.unique(object.name);
  object.parent = place.group;
  object.attributes = product.attributes;
  if (!own.empty()) object.attributes.emplace_back("Instance", own);
  if (std::string layers = labels_.layers_of(instance); !layers.empty())
    state(object.attributes, "Layer", std::move(layers));
  object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
  object.body_count = static_cast<std::uint32_t>(product.parts.size());
  std::optional<model::Color> color = labels_.color_of_occurrence(place.instances);
  if (!color) color = labels_.color_of_label(instance);
  const Placement placement =
      placement_of(place.location) * Placement{geometry::Mat3d{}, product.middle};
  for (const Product::Part& part : product.parts) {
    model::Body body;
    body.shape = part.shape;
    body.placement = placement;
    body.color = color.value_or(part.color.value_or(place.color.value_or(model::Color{})));
    model_.bodies.push_back(body);
  }
  model_.objects.push_back(std::move(object));
}

/// Adds an object for each part of a product that is all that the file has: nothing of it could
/// clash otherwise.
void SceneBuilder::add_separately(const Product& product, const Place& place, NameCounter& names) {
  if (product.parts.size() < 2) return add_instance(product, TDF_Label(), place, names);
  const std::string name = names.unique(product.name.empty() ? options_.file_name : product.name);
  Place within = place;
  within.group = add_group(name, place.group);
  within.id += name + "/";
  NameCounter own_names;
  std::size_t number = 0;
  for (const Product::Part& part : product.parts) {
    ++number;
    Product one;
    one.name = part.name.empty() || part.name == product.name ? std::to_string(number) : part.name;
    one.parts = {part};
    one.middle = product.middle;
    one.attributes = product.attributes;
    add_instance(one, TDF_Label(), within, own_names);
  }
}

void SceneBuilder::add_tree(const TDF_Label& label, const TDF_Label& instance, const Place& place,
                            NameCounter& names) {
  if (too_many_) return;
  if (!is_assembly(label)) {
    if (instance.IsNull()) return add_separately(product_of(label), place, names);
    return add_instance(product_of(label), instance, place, names);
  }
  const std::string product = Labels::name_of(label);
  const std::string own = Labels::instance_name(instance, product);
  const std::string name = names.unique(!own.empty()       ? own
                                        : !product.empty() ? product
                                                           : options_.file_name);
  Place within = place;
  within.group = add_group(name, place.group);
  within.id += name + "/";
  if (const std::optional<model::Color> own_color = labels_.color_of_occurrence(place.instances))
    within.color = own_color;
  else if (const std::optional<model::Color> color = labels_.color_of_label(instance))
    within.color = color;
  else if (const std::optional<model::Color> of_product = labels_.color_of_label(label))
    within.color = of_product;
  NameCounter inner;
  TDF_LabelSequence components;
  XCAFDoc_ShapeTool::GetComponents(label, components);
  for (const TDF_Label& component : components) {
    Place of_component = within;
    of_component.location = within.location * XCAFDoc_ShapeTool::GetLocation(component);
    of_component.instances.push_back(component);
    add_tree(referred(component), component, of_component, inner);
  }
}

/// Adds what IGES says as surfaces, one beside the other: together they are the shells of parts.
void SceneBuilder::add_loose_surfaces(const std::vector<TDF_Label>& roots, NameCounter& names) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  XCAFPrs_IndexedDataMapOfShapeStyle styles;
  for (const TDF_Label& root : roots) {
    builder.Add(all, XCAFDoc_ShapeTool::GetShape(root));
    XCAFPrs::CollectStyleSettings(root, TopLoc_Location(), styles);
  }
  const Product product = make_product(options_.file_name, all, styles);
  add_separately(product, {}, names);
}

void SceneBuilder::add_roots() {
  TDF_LabelSequence roots;
  labels_.shapes->GetFreeShapes(roots);
  std::set<std::string> visited;
  for (const TDF_Label& root : roots) count_products(root, visited);
  NameCounter names;
  std::vector<TDF_Label> surfaces;
  for (const TDF_Label& root : roots) {
    const bool is_surface =
        options_.kind == SourceKind::iges && !is_assembly(root) &&
        !TopExp_Explorer(XCAFDoc_ShapeTool::GetShape(root), TopAbs_SOLID).More();
    if (is_surface)
      surfaces.push_back(root);
    else
      add_tree(root, TDF_Label(), {}, names);
  }
  if (!surfaces.empty()) add_loose_surfaces(surfaces, names);
}

void SceneBuilder::report_left_out() {
  for (const std::string& entity : document_.not_read)
    report_.add(Severity::skipped, "step-not-read", entity.substr(0, entity.find(':')), entity);
  if (document_.unknown > 0)
    report_.add(
        Severity::note, "step-unknown-entity", "",
        std::to_string(document_.unknown) +
            " entities are of kinds that Open CASCADE does not know, and count for nothing");
  for (const std::string& file : document_.missing_files)
    report_.add(Severity::skipped, "step-file-missing", file,
                "the file that it refers to cannot be read");
  if (curves_ > 0)
    report_.add(Severity::note, "step-curves", "",
                std::to_string(curves_) + " curves that bound no face are left out");
  if (without_shape_ > 0)
    report_.add(Severity::note, "step-no-shape", "",
                std::to_string(without_shape_) + " products have no faces and are left out");
}

Result<model::Model> SceneBuilder::build() {
  add_roots();
  report_left_out();
  if (too_many_)
    return Error{ErrorCode::input, "its assemblies place more than 5 million parts", "",
                 "split the model"};
  if (model_.objects.empty())
    return Error{ErrorCode::input,
                 "nothing in it becomes an object: " +
                     std::string(product_count_ == 0 ? "no product in it has a shape"
                                                     : "no product has a face of which triangles "
                                                       "can be made"),
                 "", "export solids or surfaces, as STEP AP214 or AP242"};
  model::SourceFile source;
  source.label = options_.file_name;
  model_.files.push_back(std::move(source));
  return std::move(model_);
}

}  // namespace

Result<model::Model> make_scene_model(const Document& document, const SceneOptions& options,
                                      Report& report, const Handle(ReportProgress) & progress) {
  return SceneBuilder(document, options, report, progress).build();
}

}  // namespace strake::import_step
