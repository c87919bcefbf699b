// SPDX-License-Identifier: Apache-2.0
#include "report/exchange/pipe_joints.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "geometry/numeric/vector_math.hpp"
#include "model/ends/end_joints.hpp"
#include "model/ends/primitive_ends.hpp"
#include "report/text/csv.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::report {
namespace {

using geometry::Vec3d;

/// Cosine of the 30 degrees that two axes in line may differ by.
constexpr double kInLine = 0.8660254037844386;
/// By so much the axes of two pipes may miss each other, beside what the test takes for touching.
constexpr double kJointGapMm = 1;

/// A round end of an object, in the model's millimetres.
struct RoundEnd {
  Vec3d at, outward;
  std::optional<double> diameter_mm;
};

/// Returns the radii of the ends that model::ends_of() finds, in its order; none of a primitive
/// whose ends are not round.
std::vector<double> end_radii(const geometry::Primitive& primitive) {
  if (const auto* const c = std::get_if<geometry::CylinderPrimitive>(&primitive))
    return {c->radius, c->radius};
  if (const auto* const t = std::get_if<geometry::CircularTorusPrimitive>(&primitive))
    return {t->tube_radius, t->tube_radius};
  if (const auto* const d = std::get_if<geometry::EllipticalDishPrimitive>(&primitive))
    return {d->radius};
  if (const auto* const d = std::get_if<geometry::SphericalDishPrimitive>(&primitive))
    return {d->radius};
  std::vector<double> radii;
  if (const auto* const s = std::get_if<geometry::SnoutPrimitive>(&primitive))
    for (const double radius : {s->bottom_radius, s->top_radius})
      if (radius > 0) radii.push_back(radius);
  return radii;
}

/// Returns by how much a placement scales all lengths alike; nothing where it does not.
std::optional<double> scale_of(const geometry::Mat3d& linear) {
  constexpr double kAlike = 1e-6;
  const double x = length(linear * Vec3d{1, 0, 0});
  for (const Vec3d& axis : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
    if (!(std::fabs(length(linear * axis) - x) <= kAlike * x)) return std::nullopt;
  return x;
}

/// Appends the round ends of a body that is a primitive.
void append_primitive_ends(std::vector<RoundEnd>& out, const model::Body& body,
                           const geometry::Primitive& primitive) {
  const std::vector<double> radii = end_radii(primitive);
  const std::vector<model::PrimitiveEnd> ends = model::ends_of(primitive);
  const std::optional<double> scale = scale_of(body.placement.linear);
  for (std::size_t e = 0; e < std::min(radii.size(), ends.size()); ++e) {
    const Vec3d outward = body.placement.linear * ends[e].outward;
    const double size = length(outward);
    if (!(size > 0)) continue;
    RoundEnd end{body.placement * ends[e].centre, outward * (1 / size), std::nullopt};
    if (scale) end.diameter_mm = 2 * radii[e] * *scale;
    out.push_back(end);
  }
}

/// The round ends of the objects that touch something.
class RoundEnds {
 public:
  explicit RoundEnds(const ClashContents& contents) : ends_(contents.model.objects.size()) {
    std::vector<bool> meshes(ends_.size(), false);
    for (const clash::Report& test : contents.findings.tests)
      for (const clash::Pair& pair : test.pairs)
        if (pair.cls == clash::Class::contact)
          for (const model::ObjectId id : {pair.a, pair.b})
            if (ends_[index(id)].empty()) meshes[index(id)] = !add_primitives(contents.model, id);
    if (contents.scene == nullptr) return;
    for (const model::ObjectEnd& end : model::ends_of(*contents.scene, meshes))
      ends_[end.object].push_back({geometry::to_mm(end.at), end.outward, std::nullopt});
  }

  [[nodiscard]] const std::vector<RoundEnd>& of(model::ObjectId id) const {
    return ends_[index(id)];
  }

 private:
  /// Adds the ends of an object's primitives; returns whether it has any primitives.
  bool add_primitives(const model::Model& model, model::ObjectId id) {
    const model::Object& object = model.object(id);
    bool any = false;
    for (std::uint32_t b = 0; b < object.body_count; ++b) {
      const model::Body& body = model.bodies[object.first_body + b];
      if (body.category != model::Category::physical) continue;
      const auto* const primitive =
          std::get_if<geometry::Primitive>(&model.shapes[model::index(body.shape)]);
      if (primitive == nullptr) continue;
      any = true;
      append_primitive_ends(ends_[index(id)], body, *primitive);
    }
    return any;
  }

  std::vector<std::vector<RoundEnd>> ends_;
};

/// The joints of one pair, of which ends nearer than `within_mm` meet.
class PairJoints {
 public:
  PairJoints(const clash::ResultRef& result, const clash::Pair& pair, double within_mm)
      : result_(result), pair_(pair), within_mm_(within_mm) {}

  [[nodiscard]] std::vector<PipeJoint> of(const std::vector<RoundEnd>& a,
                                          const std::vector<RoundEnd>& b) const {
    std::vector<PipeJoint> joints;
    if (a.empty() || b.empty()) return joints;
    for (const RoundEnd& x : a)
      for (const RoundEnd& y : b) add_end_to_end(joints, x, y);
    if (!joints.empty()) return joints;
    const RoundEnd *const of_a = end_at(a), *const of_b = end_at(b);
    PipeJoint joint{result_, JointKind::side_by_side, pair_.point_mm, {}, {}};
    if (of_a != nullptr || of_b != nullptr) {
      joint.kind = JointKind::end_on_side;
      joint.at_mm = of_a != nullptr ? of_a->at : of_b->at;
      if (of_a != nullptr) joint.a_diameter_mm = of_a->diameter_mm;
      if (of_b != nullptr) joint.b_diameter_mm = of_b->diameter_mm;
    }
    return {joint};
  }

 private:
  void add_end_to_end(std::vector<PipeJoint>& joints, const RoundEnd& x, const RoundEnd& y) const {
    if (length(x.at - y.at) > within_mm_ || dot(x.outward, y.outward) > -kInLine) return;
    const Vec3d at = (x.at + y.at) * 0.5;
    // Where several bodies of an object end at one place it is one joint.
    for (const PipeJoint& joint : joints)
      if (length(joint.at_mm - at) <= within_mm_) return;
    joints.push_back({result_, JointKind::end_to_end, at, x.diameter_mm, y.diameter_mm});
  }

  /// Returns the end whose face the two touch at; null if there is none.
  [[nodiscard]] const RoundEnd* end_at(const std::vector<RoundEnd>& ends) const {
    for (const RoundEnd& end : ends) {
      const Vec3d from = pair_.point_mm - end.at;
      const double along = std::fabs(dot(from, end.outward));
      const double across = length(from - end.outward * dot(from, end.outward));
      if (along > within_mm_) continue;
      if (!end.diameter_mm || across <= *end.diameter_mm / 2 + within_mm_) return &end;
    }
    return nullptr;
  }

  const clash::ResultRef& result_;
  const clash::Pair& pair_;
  double within_mm_;
};

}  // namespace

std::string_view name(JointKind kind) {
  if (kind == JointKind::end_to_end) return "end_to_end";
  return kind == JointKind::end_on_side ? "end_on_side" : "side_by_side";
}

Result<std::vector<PipeJoint>> pipe_joints(const ClashContents& contents,
                                           const parallel::Context& context) {
  constexpr std::size_t kGrain = 256;
  const RoundEnds ends(contents);
  std::vector<clash::ResultRef> contacts;
  for (std::uint32_t t = 0; t < contents.findings.tests.size(); ++t)
    for (std::uint32_t p = 0; p < contents.findings.tests[t].pairs.size(); ++p)
      if (contents.findings.tests[t].pairs[p].cls == clash::Class::contact)
        contacts.push_back({t, p});
  const auto of_contacts = parallel::transform(
      context, {.name = "joints of pipes", .n = contacts.size(), .grain = kGrain},
      [&](std::size_t i) {
        const clash::Report& test = contents.findings.tests[contacts[i].test];
        const clash::Pair& pair = test.pairs[contacts[i].pair];
        const clash::Tolerances& t = test.options.tolerances;
        const double within = t.touch_gap_mm + t.touch_overlap_mm + kJointGapMm;
        return PairJoints(contacts[i], pair, within).of(ends.of(pair.a), ends.of(pair.b));
      });
  if (!of_contacts) return of_contacts.error();
  std::vector<PipeJoint> joints;
  for (const std::vector<PipeJoint>& some : *of_contacts)
    joints.insert(joints.end(), some.begin(), some.end());
  return joints;
}

Status write_joints_csv(const ClashContents& contents, Sink sink,
                        const parallel::Context& context) {
  const Result<std::vector<PipeJoint>> joints = pipe_joints(contents, context);
  if (!joints) return joints.error();
  BufferedWriter buffer(sink);
  begin_csv(buffer.text(), contents.csv, kJointColumns, contents.columns);
  return write_lines(context, joints->size(), buffer, [&](std::size_t i, std::string& out) {
    CsvRow row(out, contents.csv);
    append_joint_cells(row, contents, (*joints)[i]);
    row.end();
  });
}

}  // namespace strake::report
