// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bcf/input/read_bcf.hpp"
#include "bcf/output/write_bcf.hpp"
#include "core/text/dates.hpp"
#include "core/text_encoding.hpp"
#include "report/zip/zip_writer.hpp"
#include "support/clash_model.hpp"
#include "support/io_files.hpp"
#include "support/io_seeds.hpp"

namespace strake::test {

/// An archive of BCF with one topic.
[[nodiscard]] inline std::string bcf_of(std::string_view markup) {
  std::string bytes;
  const auto append = [&](std::string_view piece) { bytes += piece; };
  report::ZipWriter zip(append, {});
  const bool written =
      zip.add_file("bcf.version", std::string_view(R"(<Version VersionId="2.1"/>)")) &&
      zip.add_file("a/markup.bcf", markup) && zip.finish();
  if (!written) std::abort();
  return bytes;
}

/// What the program itself writes, in both versions, and a topic that others decided about, by
/// itself: what begins as markup does is fed as a topic, since damage to what is packed seldom
/// reaches it.
[[nodiscard]] inline std::vector<Seed> bcf_seeds() {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {80, 0, 0}, {200, 100, 100});
  m.box("c", {180, 0, 0}, {300, 100, 100});
  const clash::Findings findings{{m.detect()}, {}};
  std::vector<Seed> seeds;
  for (const bool version_3 : {false, true}) {
    report::ClashContents contents{findings, m.model};
    contents.bcf.version_3 = version_3;
    std::string bytes;
    if (!bcf::write_bcf(contents, [&](std::string_view piece) { bytes += piece; })) std::abort();
    seeds.push_back({version_3 ? "three.bcf" : "two.bcf", bytes});
  }
  seeds.push_back(
      {"topic.xml",
       R"(<?xml version="1.0" encoding="UTF-8"?><Markup><Topic )"
       R"(Guid="d0094c1a-85e8-5a4f-a794-1be75c49d629" TopicStatus="Approved"><Title>A &amp; B</Title>)"
       R"(<AssignedTo>Bob</AssignedTo><ModifiedDate>2026-02-03T12:00:00+02:00</ModifiedDate>)"
       "<Description><![CDATA[x]]>\n"
       "Strake-reference: assignee=none 0c8x2kq9w3e4r5t6y7v8b9n0mz=new</Description></Topic>"
       R"(<!-- y --><Comment Guid="11111111-1111-4111-8111-111111111111">)"
       "<Date>2026-02-03T10:00:00.250Z</Date><Author>\xC3\x96</Author><Comment>so &#x21;</Comment>"
       R"(<ModifiedDate>2026-02-03T24:00:00Z</ModifiedDate></Comment></Markup>)"});
  return seeds;
}

/// Any bytes as a BCF: an error that names the file, or topics of which all is as it is promised.
inline void feed_bcf(const std::string& bytes, const TemporaryFolder& folder) {
  const auto stop = [](const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  };
  const auto path = folder.write("fuzz.bcf", bytes.starts_with('<') ? bcf_of(bytes) : bytes);
  const Result<bcf::ReadFile> file = bcf::read_bcf(path);
  if (!file) {
    if (file.error().where.find("fuzz.bcf") == std::string::npos) stop("an error without a file");
    return;
  }
  const auto is_date = [](const std::string& date) { return utc_of(date) == date; };
  if (file->version != "2.1" && file->version != "3.0") stop("a version that is not read");
  if (std::ranges::adjacent_find(file->topics, std::ranges::greater_equal(),
                                 &bcf::ReadTopic::guid) != file->topics.end())
    stop("topics out of order, or one twice");
  for (const bcf::ReadTopic& topic : file->topics) {
    if (topic.guid.empty()) stop("a topic without a GUID");
    for (const std::string* const text :
         {&topic.guid, &topic.title, &topic.status, &topic.assignee, &topic.changer})
      if (!is_utf8(*text)) stop("a text that is no text");
    if (!topic.changed.empty() && !is_date(topic.changed)) stop("a date that is none");
    if (topic.reference && guid_of(*topic.reference) != topic.guid) stop("another's reference");
    for (const bcf::ReadComment& comment : topic.comments) {
      if (!is_utf8(comment.text) || !is_utf8(comment.author)) stop("a comment that is no text");
      if (!comment.guid.empty() && !bcf::is_guid(comment.guid)) stop("a GUID that is none");
      for (const std::string* const date : {&comment.date, &comment.first_date})
        if (!date->empty() && !is_date(*date)) stop("a date of a comment that is none");
    }
  }
}

}  // namespace strake::test
