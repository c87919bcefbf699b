// SPDX-License-Identifier: Apache-2.0
#include "project/views/view_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "hlr/results/defect_codes.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

namespace {

/// Longer lists of section planes are refused as no view has them.
constexpr std::uint64_t kMaxSections = 16;

/// Takes a value of an enumeration whose last one is known.
template <class Enum>
Enum read_enum(BlobReader& in, Enum last) {
  const std::uint64_t value = in.number();
  if (value <= static_cast<std::uint64_t>(last)) return static_cast<Enum>(value);
  in.refuse("an option has a value that this version does not know");
  return Enum{};
}

double read_finite(BlobReader& in) {
  const double value = in.real();
  if (!std::isfinite(value)) in.refuse("a number is not finite");
  return value;
}

template <class Enum>
void write_enum(BlobWriter& out, Enum value) {
  out.number(static_cast<std::uint64_t>(value));
}

}  // namespace

void write(BlobWriter& out, const geometry::Vec3l& vector) {
  for (int k = 0; k < 3; ++k) out.integer(vector[k]);
}

geometry::Vec3l read_vector(BlobReader& in) {
  geometry::Vec3l vector;
  for (int k = 0; k < 3; ++k) {
    vector[k] = in.integer();
    if (!is_on_grid(vector[k])) {
      in.refuse("a point lies outside what can be placed");
      return {};
    }
  }
  return vector;
}

void write(BlobWriter& out, const hlr::View& view) {
  write(out, view.direction);
  write(out, view.up);
  out.number(view.limits ? 1 : 0);
  if (view.limits) {
    write(out, view.limits->lo);
    write(out, view.limits->hi);
  }
  out.number(view.sections.size());
  for (const hlr::Section& section : view.sections) {
    write(out, section.normal);
    write(out, section.point);
  }
  out.number(view.perspective ? 1 : 0);
  if (!view.perspective) return;
  write(out, view.perspective->eye);
  write(out, view.perspective->target);
  out.real(view.perspective->near_mm);
  out.real(view.perspective->field_of_view_deg);
}

hlr::View read_view(BlobReader& in) {
  hlr::View view;
  view.direction = read_vector(in);
  view.up = read_vector(in);
  if (in.number() != 0) {
    const geometry::Vec3l lo = read_vector(in);
    view.limits = geometry::Box3l{lo, read_vector(in)};
  }
  const std::uint64_t sections = in.number();
  if (sections > kMaxSections) in.refuse("a view has more than 16 sections");
  for (std::uint64_t s = 0; s < sections && !in.failed(); ++s) {
    const geometry::Vec3l normal = read_vector(in);
    view.sections.push_back({normal, read_vector(in)});
  }
  if (in.number() == 0) return view;
  hlr::Perspective perspective;
  perspective.eye = read_vector(in);
  perspective.target = read_vector(in);
  perspective.near_mm = read_finite(in);
  perspective.field_of_view_deg = read_finite(in);
  view.perspective = perspective;
  return view;
}

void write(BlobWriter& out, std::span<const hlr::Hatch> hatches) {
  std::vector<double> values;
  values.reserve(hatches.size() * 2);
  for (const hlr::Hatch& hatch : hatches) {
    values.push_back(hatch.angle_deg);
    values.push_back(hatch.spacing_mm);
  }
  out.reals(values);
}

std::vector<hlr::Hatch> read_hatches(BlobReader& in) {
  const std::vector<double> values = in.column<double>();
  if (values.size() % 2 != 0) in.refuse("a hatch has no spacing");
  std::vector<hlr::Hatch> hatches;
  hatches.reserve(values.size() / 2);
  for (std::size_t h = 0; h + 1 < values.size(); h += 2)
    hatches.push_back({values[h], values[h + 1]});
  return hatches;
}

/// Which pieces are kept, in one number. Clipped ones are where nothing is said of them, as in what
/// earlier versions wrote.
constexpr std::uint64_t kKeepsHidden = 1, kCountsClipped = 2;

/// Takes all options apart: one more does not compile, here or in read_options().
void write(BlobWriter& out, const hlr::Options& options) {
  const auto& [stage, solver, sharp_angle, smooth, contact_distance, intersections, own_polylines,
               flush_seams, sag, culling, bucketing, hidden, clipped, keep_specks, hatch_spacing,
               hatches, uncut] = options;
  write_enum(out, stage);
  write_enum(out, solver);
  out.real(sharp_angle);
  write_enum(out, smooth);
  out.real(contact_distance);
  write_enum(out, intersections);
  write_enum(out, own_polylines);
  out.number(flush_seams ? 1 : 0);
  out.real(sag);
  out.number(culling ? 1 : 0);
  out.integer(bucketing);
  out.number((hidden ? kKeepsHidden : 0) | (clipped ? 0 : kCountsClipped));
  out.number(keep_specks ? 1 : 0);
  out.real(hatch_spacing);
  write(out, std::span<const hlr::Hatch>(hatches));
  out.flags(uncut);
}

hlr::Options read_options(BlobReader& in) {
  hlr::Options options;
  auto& [stage, solver, sharp_angle, smooth, contact_distance, intersections, own_polylines,
         flush_seams, sag, culling, bucketing, hidden, clipped, keep_specks, hatch_spacing, hatches,
         uncut] = options;
  stage = read_enum(in, hlr::Stage::global);
  solver = read_enum(in, hlr::Solver::push);
  sharp_angle = read_finite(in);
  smooth = read_enum(in, hlr::Smooth::all);
  contact_distance = read_finite(in);
  intersections = read_enum(in, hlr::Intersections::parts);
  own_polylines = read_enum(in, hlr::OwnPolylines::hidden);
  flush_seams = in.number() != 0;
  sag = read_finite(in);
  culling = in.number() != 0;
  const std::int64_t buckets = in.integer();
  if (buckets < hlr::Options::kBucketsByData || buckets > hlr::Options::kMaxBuckets)
    in.refuse("an option has a value that this version does not know");
  else
    bucketing = static_cast<std::int32_t>(buckets);
  const std::uint64_t kept = in.number();
  if (kept > (kKeepsHidden | kCountsClipped))
    in.refuse("an option has a value that this version does not know");
  hidden = (kept & kKeepsHidden) != 0;
  clipped = (kept & kCountsClipped) == 0;
  keep_specks = in.number() != 0;
  hatch_spacing = read_finite(in);
  hatches = read_hatches(in);
  uncut = in.flags();
  return options;
}

namespace {

/// The counters of a drawing, in the order in which they are written.
constexpr std::array kCounters{&hlr::Counters::feature_edges,  &hlr::Counters::covered_edges,
                               &hlr::Counters::face_tests,     &hlr::Counters::exact_fallbacks,
                               &hlr::Counters::crossing_pairs, &hlr::Counters::crossing_tests,
                               &hlr::Counters::specks,         &hlr::Counters::left_out,
                               &hlr::Counters::seams,          &hlr::Counters::uncut_objects};

}  // namespace

void write(BlobWriter& out, const hlr::Counters& counters) {
  for (const auto counter : kCounters) out.number(counters.*counter);
}

hlr::Counters read_counters(BlobReader& in) {
  hlr::Counters counters;
  for (const auto counter : kCounters) counters.*counter = in.number();
  return counters;
}

void write(BlobWriter& out, const hlr::Account& account) {
  std::vector<std::uint8_t> fates;
  fates.reserve(account.fates.size());
  for (const hlr::Fate fate : account.fates) fates.push_back(static_cast<std::uint8_t>(fate));
  out.column(std::span<const std::uint8_t>(fates));
  out.column(std::span<const std::uint64_t>(account.count));
  out.number(account.in_part);
  out.number(account.defects.size());
  for (const hlr::Defect& defect : account.defects) {
    out.number(model::index(defect.object));
    out.text(defect.code);
  }
}

hlr::Account read_account(BlobReader& in) {
  hlr::Account account;
  const std::vector<std::uint8_t> fates = in.column<std::uint8_t>();
  account.fates.reserve(fates.size());
  for (const std::uint8_t fate : fates) {
    if (fate >= hlr::kFates) {
      in.refuse("an object has a fate that this version does not know");
      return {};
    }
    account.fates.push_back(static_cast<hlr::Fate>(fate));
  }
  const std::vector<std::uint64_t> count = in.column<std::uint64_t>();
  if (count.size() != hlr::kFates) in.refuse("fates are not counted");
  for (std::size_t f = 0; f < std::min(count.size(), hlr::kFates); ++f) account.count[f] = count[f];
  account.in_part = in.number();
  const std::uint64_t defects = in.number();
  for (std::uint64_t d = 0; d < defects && !in.failed(); ++d) {
    const std::uint64_t object = in.number();
    if (object >= fates.size()) {
      in.refuse("a defect is of no object");
      return {};
    }
    account.defects.push_back({model::ObjectId{static_cast<std::uint32_t>(object)}, {}});
    account.defects.back().code = hlr::defect_code(in.text());
    if (account.defects.back().code.empty())
      in.refuse("a defect has a code that this version does not know");
  }
  return account;
}

void write(BlobWriter& out, const Diagnostics& diagnostics) {
  out.number(diagnostics.kept().size());
  for (const Diagnostic& d : diagnostics.kept()) {
    write_enum(out, d.severity);
    out.text(d.code);
    out.text(d.message);
    out.text(d.where);
  }
  out.number(diagnostics.counts().size());
  for (const Diagnostics::Count& count : diagnostics.counts()) {
    out.text(count.code);
    out.number(count.count);
  }
}

Diagnostics read_diagnostics(BlobReader& in) {
  Diagnostics diagnostics;
  const std::uint64_t kept = in.number();
  for (std::uint64_t i = 0; i < kept && !in.failed(); ++i) {
    Diagnostic d;
    d.severity = read_enum(in, Severity::skipped);
    d.code = in.text();
    d.message = in.text();
    d.where = in.text();
    if (!in.failed()) diagnostics.add(std::move(d));
  }
  const std::uint64_t codes = in.number();
  for (std::uint64_t i = 0; i < codes && !in.failed(); ++i) {
    const std::string code = in.text();
    const std::uint64_t count = in.number(), there = diagnostics.count(code);
    if (count < there) in.refuse("more reports are there than are counted");
    if (count > there) diagnostics.count_more(code, count - there);
  }
  return diagnostics;
}

}  // namespace strake::project
