// SPDX-License-Identifier: Apache-2.0
// bench_clash_plant SCENE.obj TRUTH.json [threads] [clearance mm]: clashes of a plant scene, whose
// maker says which pairs are what. A wrong class is an error and no time is printed.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "timed_run.hpp"

namespace {

using strake::clash::Class;
using Key = std::pair<std::uint64_t, std::uint64_t>;

Key key_of(std::uint64_t a, std::uint64_t b) { return {std::min(a, b), std::max(a, b)}; }

/// "P_123" is object 123.
std::uint64_t number_of(const std::string& name) {
  return std::strtoull(name.c_str() + name.find('_') + 1, nullptr, 10);
}

Class class_at(double gap_mm, const strake::clash::Options& o) {
  if (gap_mm <= o.tolerances.touch_gap_mm) return Class::contact;
  return gap_mm < o.tolerances.clearance_mm ? Class::clearance_violation : Class::no_hit;
}

/// The classes that are right: two where a gap is planted at a threshold, which the numbers in the
/// file of a turned scene no longer hold.
struct Truth {
  Class cls, or_else;
};

std::map<Key, Truth> truth_of(const char* path, const strake::clash::Options& options) {
  std::ifstream in(path);
  const auto json = nlohmann::json::parse(in);
  constexpr double kRounding = 0.002;
  std::map<Key, Truth> truth;
  const auto put = [&](const nlohmann::json& p, Class cls, Class or_else) {
    truth[key_of(p[0], p[1])] = {cls, or_else};
  };
  for (const auto& p : json["hard"]) {
    const std::string why = p[2];
    const bool shallow = why.starts_with("depth ") && std::strtod(why.c_str() + 6, nullptr) < 1;
    const Class cls = shallow ? Class::contact : Class::hit;
    put(p, cls, cls);
  }
  for (const auto& p : json["contained"]) put(p, Class::hit, Class::hit);
  for (const auto& p : json["touch"]) put(p, Class::contact, Class::contact);
  for (const auto& p : json["clearance"]) {
    const double gap = p[2];
    put(p, class_at(gap - kRounding, options), class_at(gap + kRounding, options));
  }
  return truth;
}

int compare(const strake::clash::Report& report, const strake::model::Model& model,
            std::map<Key, Truth> truth) {
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
    const Truth want = found == truth.end() ? Truth{Class::no_hit, Class::no_hit} : found->second;
    if (want.cls != p.cls && want.or_else != p.cls) complain(k, want.cls, p.cls, p.d_mm);
    if (found != truth.end()) truth.erase(found);
  }
  for (const auto& [k, want] : truth)
    if (want.cls != Class::no_hit && want.or_else != Class::no_hit)
      complain(k, want.cls, Class::no_hit, 0);
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: bench_clash_plant SCENE.obj TRUTH.json [threads] [clearance mm]\n");
    return argc > 1 ? 2 : 0;  // without any there is nothing to measure
  }
  const unsigned threads =
      argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : strake::parallel::default_workers();
  strake::clash::Options options;
  options.tolerances.clearance_mm = argc > 4 ? std::atof(argv[4]) : 0;
  const auto run = strake::bench::timed_run({argv[1]}, options, threads, strake::clash::one_set);
  if (!run) {
    std::fprintf(stderr, "%s\n", run.error().text().c_str());
    return 1;
  }
  const int wrong = compare(run->report, *run->model, truth_of(argv[2], options));
  if (wrong > 0) {
    std::printf("ERROR: %d wrong pairs\n", wrong);
    return 1;
  }
  std::printf(
      "{\"objects\": %zu, \"threads\": %u, \"load_s\": %.3f, \"scene_s\": %.3f, \"clash_s\": %.3f, "
      "\"total_s\": %.3f, \"candidates\": %llu, \"pairs\": %zu, \"hash\": \"%s\"}\n",
      run->model->objects.size(), threads, run->load_s, run->scene_s, run->clash_s, run->total_s(),
      static_cast<unsigned long long>(run->report.counters.candidate_pairs),
      run->report.pairs.size(), run->report.hash.c_str());
  return 0;
}
