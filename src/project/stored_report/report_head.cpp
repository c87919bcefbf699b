// SPDX-License-Identifier: Apache-2.0
#include "project/stored_report/report_head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/stored_report/report_codec.hpp"
#include "project/stored_report/value_columns.hpp"
#include "strake/model/scene.hpp"

namespace strake::project {
namespace {

using clash::Report;

/// The codes of what was not compared: reports hold literals.
constexpr std::array<std::string_view, 10> kCodes{
    "object-skipped",     "object-incomplete",   "body-without-shape", "mesh-bad-triangle",
    "polyline-bad-point", "body-unplaceable",    "shape-unplaceable",  model::kVanished,
    "pair-too-large",     "pair-in-open-surface"};

/// Writes the members of a head, or reads them, so that both have one order.
class Writer {
 public:
  explicit Writer(BlobWriter& out) : out_(out) {}
  static constexpr bool kReads = false;

  void number(const std::uint64_t& value) { out_.number(value); }
  void number(const std::uint32_t& value) { out_.number(value); }
  void index(const std::int32_t& value, std::size_t /*count*/) { out_.integer(value); }
  void real(const double& value) { out_.real(value); }
  void text(const std::string& value) { out_.text(value); }
  void flag(const bool& value) { out_.number(value ? 1 : 0); }
  template <class E>
  void word(const E& value, E /*last*/) {
    out_.number(static_cast<std::uint64_t>(value));
  }
  void flags(const std::vector<bool>& values, std::size_t /*objects*/) { out_.flags(values); }
  template <class T>
  void column(const std::vector<T>& values, std::size_t /*objects*/) {
    out_.column(std::span<const T>(values));
  }
  void object(const model::ObjectId& id, std::size_t /*objects*/) { out_.number(model::index(id)); }
  void object(const std::optional<model::ObjectId>& id, std::size_t objects) {
    flag(id.has_value());
    if (id) object(*id, objects);
  }
  template <class T, class Each>
  void list(const std::vector<T>& values, const Each& each) {
    out_.number(values.size());
    for (const T& value : values) each(value);
  }
  void relations(const clash::RelationSet& set) {
    std::uint64_t bits = 0;
    for (const clash::Relation r : clash::kRelations)
      if (set.contains(r)) bits |= std::uint64_t{1} << static_cast<unsigned>(r);
    out_.number(bits);
  }
  void code(const std::string_view& code) {
    out_.number(static_cast<std::uint64_t>(std::ranges::find(kCodes, code) - kCodes.begin()));
  }
  void refuse_unless(bool /*holds*/, std::string_view /*why*/) {}
  BlobWriter& blob() { return out_; }

 private:
  BlobWriter& out_;
};

class Reader {
 public:
  explicit Reader(BlobReader& in) : in_(in) {}
  static constexpr bool kReads = true;

  void number(std::uint64_t& value) { value = in_.number(); }
  void number(std::uint32_t& value) { value = static_cast<std::uint32_t>(limited(0xffffffffU)); }
  /// Reads the number of one of so many things, or -1.
  void index(std::int32_t& value, std::size_t count) {
    const std::int64_t read = in_.integer();
    const bool fits = read >= -1 && read < static_cast<std::int64_t>(count);
    refuse_unless(fits, "it speaks of a rule that is not there");
    value = fits ? static_cast<std::int32_t>(read) : -1;
  }
  void real(double& value) {
    value = in_.real();
    refuse_unless(!std::isnan(value), "a value is no number");
  }
  void text(std::string& value) { value = in_.text(); }
  void flag(bool& value) { value = limited(1) == 1; }
  template <class E>
  void word(E& value, E last) {
    value = static_cast<E>(limited(static_cast<std::uint64_t>(last)));
  }
  void flags(std::vector<bool>& values, std::size_t objects) {
    values = in_.flags();
    refuse_unless(values.empty() || values.size() == objects, kNotThatMany);
  }
  template <class T>
  void column(std::vector<T>& values, std::size_t objects) {
    values = in_.column<T>();
    refuse_unless(values.empty() || values.size() == objects, kNotThatMany);
  }
  void object(model::ObjectId& id, std::size_t objects) {
    const std::uint64_t read = in_.number();
    refuse_unless(read < objects, "it speaks of an object that is not there");
    id = model::ObjectId{read < objects ? static_cast<std::uint32_t>(read) : 0};
  }
  void object(std::optional<model::ObjectId>& id, std::size_t objects) {
    bool is_there = false;
    flag(is_there);
    if (is_there) object(id.emplace(), objects);
  }
  template <class T, class Each>
  void list(std::vector<T>& values, const Each& each) {
    for (std::uint64_t n = in_.number(); n > 0 && !in_.failed(); --n) each(values.emplace_back());
  }
  void relations(clash::RelationSet& set) {
    const std::uint64_t bits = limited((std::uint64_t{1} << clash::kRelations.size()) - 1);
    for (const clash::Relation r : clash::kRelations)
      if ((bits >> static_cast<unsigned>(r) & 1U) != 0) set.add(r);
  }
  void code(std::string_view& code) { code = kCodes[limited(kCodes.size() - 1)]; }
  void refuse_unless(bool holds, std::string_view why) {
    if (!holds && !in_.failed()) in_.refuse(why);
  }
  BlobReader& blob() { return in_; }

 private:
  static constexpr std::string_view kNotThatMany = "it is about another number of objects";
  std::uint64_t limited(std::uint64_t last) {
    const std::uint64_t value = in_.number();
    refuse_unless(value <= last, "a value is none of those that there are");
    return value <= last ? value : 0;
  }
  BlobReader& in_;
};

/// Takes a report from a reader or to a writer: `R` is Report, or const Report.
template <class Io, class R>
class Head {
 public:
  Head(Io& io, R& report, std::size_t objects) : io_(io), report_(report), objects_(objects) {}

  void run() {
    io_.text(report_.name);
    io_.text(report_.set_a);
    io_.text(report_.set_b);
    options(report_.options);
    counts();
    rules();
    matrix();
    objects();
    work();
    io_.real(report_.contact_distance_mm);
    io_.real(report_.weld_mm);
    io_.text(report_.hash);
    diagnostics();
  }

 private:
  template <class T>
  void tolerances(T& t) {
    auto& [clearance, gap, overlap, cap, added] = t;  // of all members, or it does not compile
    io_.real(clearance);
    io_.real(gap);
    io_.real(overlap);
    io_.word(cap, clash::ThicknessCap::off);
    clearances(added);
  }

  /// Cells of a matrix share what objects add: it is written where it comes first.
  void clearances(const std::shared_ptr<const clash::ObjectClearances>& added)
    requires(!Io::kReads)
  {
    const auto at = std::ranges::find(shared_, added);
    io_.blob().number(static_cast<std::uint64_t>(at - shared_.begin()));
    if (at != shared_.end()) return;
    io_.blob().number(added ? 1 : 0);
    if (added) {
      io_.blob().text(added->attribute);
      io_.blob().reals(added->mm);
    }
    shared_.push_back(added);
  }
  void clearances(std::shared_ptr<const clash::ObjectClearances>& added)
    requires(Io::kReads)
  {
    const std::uint64_t at = io_.blob().number();
    io_.refuse_unless(at <= shared_.size(), "clearances are not there");
    if (at > shared_.size()) return;
    if (at == shared_.size()) {
      shared_.emplace_back();
      if (io_.blob().number() != 0) {
        auto read = std::make_shared<clash::ObjectClearances>();
        read->attribute = io_.blob().text();
        read->mm = io_.blob().template column<double>();
        io_.refuse_unless(read->mm.size() == objects_, "clearances are of other objects");
        shared_.back() = std::move(read);
      }
    }
    added = shared_[at];
  }

  template <class O>
  void options(O& o) {
    tolerances(o.tolerances);
    io_.real(o.contact_distance_mm);
    auto& [broad, narrow, spheres, volumes, curves, contacts, regions, log, keep, pairs] = o.engine;
    io_.word(broad, clash::BroadPhase::all_pairs);
    io_.word(narrow, clash::NarrowPhase::sphere_subdivision);
    io_.number(spheres);
    io_.word(volumes, clash::Volumes::on);
    io_.word(curves, clash::Curves::on);
    io_.word(contacts, clash::Contacts::count);
    io_.number(regions);
    io_.flag(log);
    io_.flag(keep);
    io_.number(pairs);
    io_.relations(o.reporting.relations);
    io_.real(o.reporting.min_volume_mm3);
  }

  void counts() {
    io_.number(report_.unlisted.contacts);
    io_.number(report_.unlisted.allowed);
    for (auto* const c : {&report_.not_reported.by_relation, &report_.not_reported.by_volume})
      for (auto* const n : {&c->hit, &c->contact, &c->clearance_violation, &c->allowed})
        io_.number(*n);
    for (auto* const n :
         {&report_.objects_a, &report_.objects_b, &report_.count_hit, &report_.count_contact,
          &report_.count_clearance, &report_.count_allowed, &report_.count_allowed_regions})
      io_.number(*n);
  }

  void rules() {
    io_.list(report_.exempted, [&](auto& e) {
      io_.text(e.rule);
      io_.number(e.pairs);
      io_.index(e.shadowed_by, 0x7fffffffU);
    });
    for (const clash::Exempted& e : report_.exempted)
      io_.refuse_unless(e.shadowed_by < static_cast<std::int64_t>(report_.exempted.size()),
                        "an exemption is shadowed by none");
    io_.flag(report_.lists_exempted);
    io_.list(report_.exempted_pairs, [&](auto& p) {
      io_.object(p.a, objects_);
      io_.object(p.b, objects_);
      io_.number(p.rule);
      io_.refuse_unless(p.rule < report_.exempted.size(), "a pair is exempted by no rule");
    });
    io_.list(report_.allowed, [&](auto& a) {
      io_.text(a.rule);
      io_.number(a.candidates);
      io_.number(a.pairs);
      io_.number(a.regions);
      io_.index(a.shadowed_by, 0x7fffffffU);
    });
    for (const clash::AllowedCount& a : report_.allowed)
      io_.refuse_unless(a.shadowed_by < static_cast<std::int64_t>(report_.allowed.size()),
                        "an allowance is shadowed by none");
  }

  void matrix() {
    io_.flag(report_.levels);
    io_.list(report_.disciplines, [&](auto& d) {
      io_.text(d.name);
      io_.number(d.objects);
    });
    io_.list(report_.cells, [&](auto& c) {
      io_.number(c.a);
      io_.number(c.b);
      io_.refuse_unless(c.a < report_.disciplines.size() && c.b < report_.disciplines.size(),
                        "a cell is of no discipline");
      io_.flag(c.checked);
      tolerances(c.tolerances);
      for (auto* const n : {&c.hit, &c.contact, &c.clearance_violation, &c.allowed}) io_.number(*n);
    });
  }

  void objects() {
    io_.column(report_.discipline, objects_);
    for (const std::uint32_t d : report_.discipline)
      io_.refuse_unless(d == clash::kNoLabel || d < report_.disciplines.size(),
                        "an object is of a discipline that is not there");
    const bool lacks = !report_.disciplines.empty() && report_.discipline.size() != objects_;
    io_.refuse_unless(!lacks, "it does not say which object is of which discipline");
    io_.flags(report_.in_a, objects_);
    io_.flags(report_.in_b, objects_);
    io_.refuse_unless(report_.in_a.size() == objects_ && report_.in_b.size() == objects_,
                      "its sets are of other objects");
    io_.column(report_.sheets, objects_);
    io_.flag(report_.within_files);
    io_.list(report_.not_compared, [&](auto& n) {
      io_.object(n.a, objects_);
      io_.object(n.b, objects_);
      io_.code(n.code);
    });
  }

  void work() {
    auto& c = report_.counters;
    for (auto* const n : {&c.candidate_pairs, &c.allowed_pairs, &c.part_pairs, &c.triangle_pairs,
                          &c.exact_fallbacks, &c.depth_cells, &c.volume_triangle_pairs,
                          &c.volumes_given_up, &c.regions_given_up})
      io_.number(*n);
  }

  void diagnostics()
    requires(!Io::kReads)
  {
    io_.list(report_.diagnostics.kept(), [&](const Diagnostic& d) { diagnostic(d); });
    std::vector<KeptCount> more;
    for (const Diagnostics::Count& c : report_.diagnostics.counts())
      if (c.count > Diagnostics::kMaxPerCode)
        more.push_back({c.code, c.count - Diagnostics::kMaxPerCode});
    io_.list(std::as_const(more), [&](const KeptCount& c) { kept_count(c); });
  }
  void diagnostics()
    requires(Io::kReads)
  {
    std::vector<Diagnostic> kept;
    std::vector<KeptCount> more;
    io_.list(kept, [&](Diagnostic& d) { diagnostic(d); });
    io_.list(more, [&](KeptCount& c) { kept_count(c); });
    for (Diagnostic& d : kept) report_.diagnostics.add(std::move(d));
    for (const KeptCount& c : more) report_.diagnostics.count_more(c.code, c.more);
  }
  /// Diagnostics that are only counted.
  struct KeptCount {
    std::string code;
    std::uint64_t more = 0;
  };
  template <class U>
  void kept_count(U& c) {
    io_.text(c.code);
    io_.number(c.more);
  }
  template <class D>
  void diagnostic(D& d) {
    io_.word(d.severity, Severity::skipped);
    io_.text(d.code);
    io_.text(d.message);
    io_.text(d.where);
  }

  Io& io_;
  R& report_;
  std::size_t objects_;
  std::vector<std::shared_ptr<const clash::ObjectClearances>> shared_;
};

}  // namespace

Result<std::vector<std::byte>> encode_head(const clash::Report& report) {
  BlobWriter out;
  Writer writer(out);
  Head(writer, report, report.in_a.size()).run();
  return out.finish();
}

Result<clash::Report> decode_head(std::span<const std::byte> bytes, std::size_t objects,
                                  const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  clash::Report report;
  Reader reader(*in);
  Head(reader, report, objects).run();
  if (const Status status = in->finish(); !status) return status.error();
  return report;
}

}  // namespace strake::project
