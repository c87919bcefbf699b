// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/measure.hpp"
#include "cli/evaluate/peers/peer_runs.hpp"
#include "cli/evaluate/placed_model.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/studies/studies.hpp"
#include "core/stopwatch.hpp"
#include "strake/clash/clash.hpp"

namespace strake::cli {

namespace {

CaseRecord case_of(std::string_view name, std::string_view title, const PlacedModel& ship) {
  CaseRecord one;
  one.name = name;
  one.title = title;
  one.objects = ship.model->objects.size();
  one.bodies = ship.scene.bodies.size();
  one.triangles = ship.triangles;
  return one;
}

/// Runs the cases that are requested.
class Evaluation {
 public:
  Evaluation(const std::vector<std::string>& names, EvaluationRecord& record,
             const std::stop_token& stop, const EvaluationHooks& hooks)
      : record_(record), stop_(stop), hooks_(hooks), wanted_(names.begin(), names.end()) {
    for (const CaseRecord& one : record.cases) wanted_.erase(one.name);
    for (const StudyRecord& study : record.studies) wanted_.erase(study.name);
    std::erase_if(record.peers, [&](const PeerRecord& peer) {
      return wanted_.contains(peer.name) && hooks.peers && may_be_retried(peer);
    });
    for (const PeerRecord& peer : record.peers) wanted_.erase(peer.name);
    for (const ViewCase& view : view_cases())
      if (wanted_.contains(std::string(view.name))) to_do_ += weight_of(view);
    for (const ShipCase& ship : ship_cases())
      if (wanted_.contains(std::string(ship.name))) to_do_ += kShipWeight;
    for (const StudyCase& study : study_cases())
      if (wanted_.contains(std::string(study.name))) to_do_ += kStudyWeight;
    for (const PeerCase& peer : peer_cases())
      if (hooks.peers && wanted_.contains(std::string(peer.name))) to_do_ += kPeerWeight;
  }

  Status run() {
    for (const ViewedShip ship : {ViewedShip::whole, ViewedShip::crowd})
      if (const Status status = views_of(ship); !status) return status;
    for (const ShipCase& ship : ship_cases())
      if (wanted_.contains(std::string(ship.name)))
        if (const Status status = clash(ship); !status) return status;
    for (const StudyCase& study : study_cases())
      if (wanted_.contains(std::string(study.name)))
        if (const Status status = run_study(study); !status) return status;
    for (const PeerCase& peer : peer_cases())
      if (hooks_.peers && wanted_.contains(std::string(peer.name)))
        if (const Status status = run_peer_case(peer); !status) return status;
    return {};
  }

 private:
  // How much of the time a case takes, for the time to go; of a view of the whole ship: 1.
  static constexpr double kShipWeight = 6, kStudyWeight = 3, kPartWeight = 0.4, kPeerWeight = 6;
  static double weight_of(const ViewCase& view) { return view.limits ? kPartWeight : 1; }

  Status views_of(ViewedShip which) {
    const auto is_wanted = [&](const ViewCase& view) {
      return view.ship == which && wanted_.contains(std::string(view.name));
    };
    if (std::ranges::none_of(view_cases(), is_wanted)) return {};
    narrate("generating a ship");
    const auto ship = place_ship(viewed_ship(which, record_.settings.scale), {}, stop_);
    if (!ship) return ship.error();
    for (const ViewCase& view : view_cases())
      if (is_wanted(view))
        if (const Status status = draw(view, *ship); !status) return status;
    return {};
  }

  Status draw(const ViewCase& view, const PlacedModel& ship) {
    CaseRecord one = case_of(view.name, view.title, ship);
    const hlr::View hlr_view = view_of(view, ship.box);
    for (const auto& [stage, name] :
         {std::pair(hlr::Stage::local, "local"), std::pair(hlr::Stage::global, "global")}) {
      Result<StageRecord> measured =
          measure(view.name, name,
                  drawing_contenders(ship.scene, hlr_view, stage, record_.settings.threads));
      if (!measured) return measured.error();
      one.stages.push_back(std::move(*measured));
    }
    return finish(std::move(one), weight_of(view));
  }

  Status clash(const ShipCase& kind) {
    const clash::Options options{.tolerances = {.clearance_mm = generate::Truth::kClearanceMm}};
    narrate("generating a ship");
    const auto ship = place_ship(clashing_ship(kind, record_.settings.scale),
                                 clash::scene_options(options), stop_);
    if (!ship) return ship.error();
    CaseRecord one = case_of(kind.name, kind.title, *ship);
    Result<StageRecord> measured = measure(
        kind.name, "clash", clash_contenders(ship->scene, options, record_.settings.threads));
    if (!measured) return measured.error();
    one.stages.push_back(std::move(*measured));
    return finish(std::move(one), kShipWeight);
  }

  Result<StageRecord> measure(std::string_view name, std::string_view stage,
                              const std::vector<Contender>& contenders) {
    return measure_stage(
        std::string(stage), contenders, record_.settings, stop_,
        [&](const std::string& what) { narrate(fmt::format("{}, {}: {}", name, stage, what)); });
  }

  Status run_study(const StudyCase& study) {
    StudyRecord one;
    one.name = study.name;
    one.title = study.title;
    one.question = study.question;
    const StudyInput input{record_.settings, stop_,
                           [&](const std::string& what) { narrate(what); }};
    if (const Status status = study.run(input, one); !status) return status;
    done_ += kStudyWeight;
    record_.studies.push_back(std::move(one));
    return hooks_.save("study " + std::string(study.name) + " done", record_);
  }

  Status run_peer_case(const PeerCase& peer) {
    narrate(fmt::format("{}: {}, {} objects", peer.name, peer.title,
                        peer_objects(peer, record_.settings.scale)));
    Result<PeerRecord> answer = run_peer(peer, *hooks_.peers, record_.settings.scale, stop_);
    if (!answer) return answer.error();
    done_ += kPeerWeight;
    const std::string line = outcome_line(*answer);
    record_.peers.push_back(std::move(*answer));
    std::ranges::sort(record_.peers, {}, [](const PeerRecord& one) {
      return std::ranges::find(peer_cases(), one.name, &PeerCase::name) - peer_cases().begin();
    });
    return hooks_.save(line, record_);
  }

  /// Adds a case to the record in its place, and saves.
  Status finish(CaseRecord one, double weight) {
    done_ += weight;
    std::vector<std::string> order;
    for (const CaseGroup& group : case_groups())
      order.insert(order.end(), group.cases.begin(), group.cases.end());
    const auto rank = [&](const CaseRecord& x) { return std::ranges::find(order, x.name); };
    const auto place = std::ranges::find_if(
        record_.cases, [&](const CaseRecord& other) { return rank(one) < rank(other); });
    return hooks_.save(outcome_line(*record_.cases.insert(place, std::move(one)), record_.settings),
                       record_);
  }

  void narrate(const std::string& what) const {
    if (done_ == 0) return hooks_.narrate(what);
    hooks_.narrate(
        fmt::format("{}; about {:.0f} s to go", what, watch_.seconds() * (to_do_ - done_) / done_));
  }

  EvaluationRecord& record_;
  std::stop_token stop_;
  const EvaluationHooks& hooks_;
  std::set<std::string> wanted_;
  double to_do_ = 0, done_ = 0;
  Stopwatch watch_;
};

}  // namespace

std::vector<CaseGroup> case_groups() {
  std::vector<CaseGroup> groups{{"views", {}}, {"ships", {}}, {"studies", {}}, {kPeersGroup, {}}};
  for (const ViewCase& view : view_cases()) groups[0].cases.emplace_back(view.name);
  for (const ShipCase& ship : ship_cases()) groups[1].cases.emplace_back(ship.name);
  for (const StudyCase& study : study_cases()) groups[2].cases.emplace_back(study.name);
  for (const PeerCase& peer : peer_cases()) groups[3].cases.emplace_back(peer.name);
  return groups;
}

Status evaluate(const std::vector<std::string>& names, EvaluationRecord& record,
                const std::stop_token& stop, const EvaluationHooks& hooks) {
  return Evaluation(names, record, stop, hooks).run();
}

}  // namespace strake::cli
