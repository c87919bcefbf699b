// SPDX-License-Identifier: Apache-2.0
// bench_clash_plant SCENE.obj TRUTH.json [threads] [clearance mm]: clashes of a plant scene, whose
// maker says which pairs are what. A wrong class is an error and no time is printed.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace {

using strake::clash::Class;
using Key = std::pair<std::uint64_t, std::uint64_t>;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Key key_of(std::uint64_t a, std::uint64_t b) { return {std::min(a, b), std::max(a, b)}; }

/// "P_123" is object 123.
std::uint64_t number_of(const std::string& name) {
  return std::strtoull(name.c_str() + name.find('_') + 1, nullptr, 10);
}

Class class_at(double gap_mm, const strake::clash::Options& o) {
  if (gap_mm <= o.touch_gap_mm) return Class::contact;
  return gap_mm < o.clearance_mm ? Class::clearance_violation : Class::no_hit;
}

std::map<Key, Class> truth_of(const char* path, const strake::clash::Options& options) {
  std::ifstream in(path);
  const auto json = nlohmann::json::parse(in);
  std::map<Key, Class> truth;
  const auto put = [&](const nlohmann::json& p, Class cls) {
    if (cls != Class::no_hit) truth[key_of(p[0], p[1])] = cls;
  };
  for (const auto& p : json["hard"]) {
    const std::string why = p[2];
    const bool shallow = why.starts_with("depth ") && std::strtod(why.c_str() + 6, nullptr) < 1;
    put(p, shallow ? Class::contact : Class::hit);
  }
  for (const auto& p : json["contained"]) put(p, Class::hit);
  for (const auto& p : json["touch"]) put(p, Class::contact);
  for (const auto& p : json["clearance"]) put(p, class_at(p[2], options));
  return truth;
}

int compare(const strake::clash::Report& report, const strake::model::Model& model,
            std::map<Key, Class> truth) {
  int wrong = 0;
  const auto complain = [&](const Key& k, Class want, Class got, double d) {
    if (++wrong <= 10)
      std::printf("pair %llu %llu: %s, should be %s (d %.6f)\n",
                  static_cast<unsigned long long>(k.first),
                  static_cast<unsigned long long>(k.second), std::string(name(got)).c_str(),
                  std::string(name(want)).c_str(), d);
  };
  for (const auto& p : report.pairs) {
    const Key k = key_of(number_of(model.object(p.a).name), number_of(model.object(p.b).name));
    const auto found = truth.find(k);
    const Class want = found == truth.end() ? Class::no_hit : found->second;
    if (want != p.cls) complain(k, want, p.cls, p.d_mm);
    if (found != truth.end()) truth.erase(found);
  }
  for (const auto& [k, want] : truth) complain(k, want, Class::no_hit, 0);
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: bench_clash_plant SCENE.obj TRUTH.json [threads] [clearance mm]\n");
    return 2;
  }
  strake::parallel::Team team(argc > 3 ? static_cast<unsigned>(std::atoi(argv[3]))
                                       : strake::parallel::default_workers());
  const strake::parallel::Context context{.team = &team, .stop = {}};
  strake::clash::Options options;
  options.clearance_mm = argc > 4 ? std::atof(argv[4]) : 0;

  const double start = seconds();
  const std::vector<std::filesystem::path> paths{argv[1]};
  const auto model = strake::io::read_models(paths, {}, context);
  if (!model) {
    std::fprintf(stderr, "%s\n", model.error().text().c_str());
    return 1;
  }
  const double loaded = seconds();
  const auto scene =
      strake::model::make_scene(*model, strake::clash::scene_options(options), context);
  if (!scene) return 1;
  const double placed = seconds();
  const auto report =
      strake::clash::detect(*scene, strake::clash::one_set(*scene), options, context);
  if (!report) return 1;
  const double done = seconds();
  const int wrong = compare(*report, *model, truth_of(argv[2], options));
  if (wrong > 0) {
    std::printf("ERROR: %d wrong pairs\n", wrong);
    return 1;
  }
  std::printf(
      "{\"objects\": %zu, \"threads\": %u, \"load_s\": %.3f, \"scene_s\": %.3f, \"clash_s\": %.3f, "
      "\"total_s\": %.3f, \"candidates\": %llu, \"pairs\": %zu, \"hash\": \"%s\"}\n",
      model->objects.size(), team.size(), loaded - start, placed - loaded, done - placed,
      done - start, static_cast<unsigned long long>(report->counters.candidate_pairs),
      report->pairs.size(), report->hash.c_str());
  return 0;
}
