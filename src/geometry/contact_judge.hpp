// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/contacts.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/plane_rim.hpp"
#include "geometry/sectors.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {

/// Says of pairs of triangles of two parts, one after the other, what their contacts mean for the
/// parts: what each touch adds, and whether a plane parts them all.
class ContactJudge {
 public:
  /// `whole`: to try whether a plane parts all of a from all of b, of which there is nothing but
  /// what the views show.
  ContactJudge(const PartView& a, const PartView& b, bool whole) : a_(a), b_(b), whole_(whole) {}

  [[nodiscard]] const Contacts& found() const { return found_; }
  /// How many of the pairs of triangles had a point in common.
  [[nodiscard]] std::uint64_t touches() const { return touches_; }

  /// A triangle of each part, ready or not. Tells whether to go on: nothing has decided so far.
  bool judge_pair(std::uint32_t ta, std::uint32_t tb);
  bool judge_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                  const ExactTriangle& b);

  /// A side at the rim of a's faces in a coordinate plane, or of b's, that runs inside a face of
  /// the other part in that plane, of which a triangle is given. `point`: some point of the side.
  void rim_in_face_of_b(const TriangleSide& side, std::uint32_t tb, const Vec3d& point);
  void rim_in_face_of_a(const TriangleSide& side, std::uint32_t ta, const Vec3d& point);

  /// Adds what other pairs of triangles of the same parts have said.
  void take(const Contacts& more);

 private:
  bool touching(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a, const ExactTriangle& b,
                const TriangleContact& c);
  void stand_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point);
  void insert_linear(std::uint32_t ta, std::uint32_t tb);

  bool separated(const ExactTriangle& a, const ExactTriangle& b);
  bool parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c);
  void judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb);
  void edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge);
  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b);
  template <class AddRays>
  void judge_rim(std::uint32_t ta, std::uint32_t tb, const Vec3d& point, const AddRays& add_rays);

  PartView a_, b_;
  bool whole_;
  Contacts found_;
  std::uint64_t touches_ = 0;
  int separation_tries_ = 0, parting_tries_ = 0;
  Sectors sectors_;
};

}  // namespace strake::geometry
