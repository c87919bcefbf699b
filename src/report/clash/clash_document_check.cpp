// SPDX-License-Identifier: Apache-2.0
#include "report/clash/clash_document_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/document/document_reader.hpp"

namespace strake::report {
namespace {

std::string of_test(std::size_t test) { return "tests[" + std::to_string(test) + "]"; }

void count(const DocumentResult& result, DocumentCounts& counts) {
  if (result.rule != 0)
    ++counts.allowed;
  else if (result.cls == clash::Class::hit)
    ++counts.hit;
  else if (result.cls == clash::Class::contact)
    ++counts.contact;
  else
    ++counts.clearance_violation;
}

void check_counts(const ClashDocument& document) {
  std::vector<DocumentCounts> found(document.tests.size());
  for (const DocumentResult& result : document.results) count(result, found[result.test]);
  for (std::size_t t = 0; t < found.size(); ++t) {
    const DocumentCounts &is = found[t], &stated = document.tests[t].counts;
    const DocumentCounts unlisted = document.tests[t].unlisted.value_or(DocumentCounts{});
    struct CountCheck {
      const char* name;
      std::uint64_t stated, is, unlisted;
    };
    for (const CountCheck& c :
         {CountCheck{"HIT", stated.hit, is.hit, 0},
          CountCheck{"CONTACT", stated.contact, is.contact, unlisted.contact},
          CountCheck{"CLEARANCE_VIOLATION", stated.clearance_violation, is.clearance_violation, 0},
          CountCheck{"ALLOWED", stated.allowed, is.allowed, unlisted.allowed}})
      if (c.stated < c.unlisted || c.stated - c.unlisted != c.is)
        throw contradiction(
            of_test(t), "counts " + std::to_string(c.stated) + " " + c.name +
                            ", but \"results\" has " + std::to_string(c.is) +
                            (c.unlisted == 0 ? std::string()
                                             : " and \"unlisted\" " + std::to_string(c.unlisted)));
  }
}

void check_places(const ClashDocument& document) {
  std::vector<std::uint64_t> found(document.tests.size(), 0);
  for (const DocumentResult& result : document.results)
    found[result.test] += result.allowed_regions;
  for (std::size_t t = 0; t < found.size(); ++t)
    if (const auto& stated = document.tests[t].allowed_other_regions; stated && *stated != found[t])
      throw contradiction(of_test(t), "counts " + std::to_string(*stated) +
                                          " places that rules allow, but \"results\" has " +
                                          std::to_string(found[t]));
}

void check_names(const ClashDocument& document) {
  std::vector<std::string_view> names;
  for (const DocumentTest& test : document.tests) names.push_back(test.name);
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice != names.end())
    throw contradiction("the document", "has two tests of the name '" + std::string(*twice) + "'");
}

void check_results(const ClashDocument& document) {
  std::vector<bool> known(document.objects.size());
  for (std::size_t o = 0; o < known.size(); ++o)
    known[o] = std::ranges::binary_search(
        document.elements, clash::element_hash(document.objects[o].file, document.objects[o].id));
  for (const DocumentResult& r : document.results) {
    const DocumentObject &a = document.a(r), &b = document.b(r);
    const auto named = [&] { return "result " + clash::key_text(r.key); };
    for (const std::uint32_t o : {r.a, r.b})
      if (!known[o])
        throw contradiction(named(), "is of '" + std::string(document.objects[o].id) +
                                         "', which is not among the \"elements\"");
    if (clash::pair_hash(document.tests[r.test].name, {a.file, a.id}, {b.file, b.id}) != r.key)
      throw contradiction(named(), "has not the key of its test and its two objects");
  }
}

void check_hash(const ClashDocument& document) {
  clash::Findings findings;
  for (const DocumentTest& test : document.tests) {
    clash::Report& report = findings.tests.emplace_back();
    report.name = test.name;
    report.hash = test.hash;
  }
  if (clash::hash_of(findings) != document.hash)
    throw contradiction("the document", "has not the \"hash\" of its tests");
}

}  // namespace

void check_against_itself(const ClashDocument& document) {
  check_names(document);
  check_counts(document);
  check_places(document);
  check_results(document);
  check_hash(document);
}

}  // namespace strake::report
