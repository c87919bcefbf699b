// SPDX-License-Identifier: Apache-2.0
#include "bcf/output/write_bcf.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "bcf/output/extensions.hpp"
#include "bcf/output/markup.hpp"
#include "bcf/output/viewpoint_file.hpp"
#include "bcf/topics/reference.hpp"
#include "bcf/topics/topic_facts.hpp"
#include "bcf/topics/topic_plan.hpp"
#include "core/text/counted.hpp"
#include "pictures/clash_picture.hpp"
#include "report/zip/zip_writer.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::bcf {
namespace {

constexpr std::uint32_t kPictureWidth = 800, kPictureHeight = 600;

/// What of a topic goes into the archive.
struct TopicFiles {
  std::string guid;
  std::vector<std::pair<const char*, report::PackedFile>> files;
};

/// The viewpoint of a topic: its GUID, its file and its picture.
struct TopicViewpoint {
  std::string guid, file, picture;
};

Result<TopicViewpoint> make_viewpoint(const pictures::Scenery& scenery, const PlannedTopic& topic,
                                      const std::string& topic_guid,
                                      const parallel::Context& context) {
  const report::ClashContents& contents = scenery.contents();
  const pictures::Subject subject = topic.group != nullptr
                                        ? pictures::subject_of(contents, *topic.group)
                                        : pictures::subject_of(topic.results.front());
  const Result<pictures::ClashViewpoint> viewpoint =
      pictures::choose_viewpoint(scenery, subject, {}, context);
  if (!viewpoint) return viewpoint.error();
  // A viewpoint never changes: what is seen differently is another one.
  TopicViewpoint view;
  view.guid = part_guid(topic_guid, viewpoint_file(contents, topic, topic_guid, *viewpoint));
  view.file = viewpoint_file(contents, topic, view.guid, *viewpoint);
  const Result<pictures::ClashPicture> drawn =
      pictures::draw_clash(scenery, subject, *viewpoint, {.caption = false}, context);
  if (!drawn) return drawn.error();
  Result<std::string> picture = pictures::png_of(*drawn, kPictureWidth, kPictureHeight);
  if (!picture) return picture.error();
  view.picture = std::move(*picture);
  return view;
}

Status add_packed(TopicFiles& topic, const char* name, const std::string& bytes) {
  Result<report::PackedFile> packed = report::pack(bytes);
  if (!packed) return packed.error();
  topic.files.emplace_back(name, std::move(*packed));
  return {};
}

/// Makes the files of a topic; `scenery` is null where nothing can be shown.
Result<TopicFiles> make_topic(const report::ClashContents& contents,
                              const pictures::Scenery* scenery, const PlannedTopic& topic,
                              const parallel::Context& context) {
  const TopicFacts facts = facts_of(contents, topic);
  TopicFiles made{facts.guid, {}};
  TopicViewpoint view;
  if (scenery != nullptr) {
    Result<TopicViewpoint> viewpoint = make_viewpoint(*scenery, topic, facts.guid, context);
    if (!viewpoint) return viewpoint.error();
    view = std::move(*viewpoint);
  }
  const std::string markup = markup_file(facts, {contents.bcf.version_3, view.guid});
  if (const Status status = add_packed(made, "markup.bcf", markup); !status) return status.error();
  if (scenery == nullptr) return made;
  if (const Status status = add_packed(made, kViewpointFile, view.file); !status)
    return status.error();
  if (const Status status = add_packed(made, kSnapshotFile, view.picture); !status)
    return status.error();
  return made;
}

Status add_topic(report::ZipWriter& zip, const TopicFiles& topic) {
  if (const Status status = zip.add_folder(topic.guid + "/"); !status) return status;
  for (const auto& [name, file] : topic.files)
    if (const Status status = zip.add_file(topic.guid + "/" + name, file); !status) return status;
  return {};
}

/// Writes all topics in their order, made by the team. What the sink throws comes out.
Status add_topics(report::ZipWriter& zip, const report::ClashContents& contents,
                  const TopicPlan& plan, const parallel::Context& context) {
  std::optional<pictures::Scenery> scenery;
  if (contents.scene != nullptr) {
    Result<pictures::Scenery> made = pictures::Scenery::of(contents, context);
    if (!made) return made.error();
    scenery.emplace(std::move(*made));
  }
  const parallel::Context alone{.stop = context.stop};
  const parallel::ProgressPhase phase(context.progress, "topics", plan.topics.size());
  std::size_t next = 0;
  std::exception_ptr thrown;
  const Status status = parallel::pipeline(
      context, {.name = "topics"},
      [&]() -> std::optional<std::size_t> {
        if (next >= plan.topics.size()) return std::nullopt;
        return next++;
      },
      [&](std::size_t t) {
        return make_topic(contents, scenery ? &*scenery : nullptr, plan.topics[t], alone);
      },
      [&](const TopicFiles& topic) -> Status {
        try {
          phase.add(1);
          return add_topic(zip, topic);
        } catch (...) {
          thrown = std::current_exception();
          return Error{ErrorCode::internal, "the sink threw", {}, {}};
        }
      });
  if (thrown) std::rethrow_exception(thrown);
  return status;
}

}  // namespace

Status write_bcf(const report::ClashContents& given, report::Sink sink,
                 const parallel::Context& context) {
  report::ClashContents contents = given;
  if (contents.bcf.date.empty()) contents.bcf.date = newest_date(contents.model);
  const TopicPlan plan = plan_topics(contents);
  report::ZipWriter zip(sink, "write fewer topics with --bcf-max-topics");
  if (const Status status = zip.add_file("bcf.version", version_file(contents.bcf.version_3));
      !status)
    return status;
  if (contents.bcf.version_3)
    if (const Status status = zip.add_file("extensions.xml", extensions_file(contents, plan));
        !status)
      return status;
  if (const Status status = add_topics(zip, contents, plan, context); !status) return status;
  return zip.finish();
}

bool is_dated(const report::ClashContents& contents) {
  return !contents.bcf.date.empty() || !newest_date(contents.model).empty();
}

std::uint64_t strange_dates_of_bcf(const report::ClashContents& contents) {
  return count_strange_dates(contents, plan_topics(contents));
}

std::string left_out_of_bcf(const report::ClashContents& contents) {
  const LeftOutCounts left_out = plan_topics(contents).left_out;
  std::string text;
  if (left_out.groups > 0) text = counted(left_out.groups, "group");
  if (left_out.results > 0) text = counted(left_out.results, "result");
  if (!text.empty()) text += " beyond the first " + std::to_string(contents.bcf.max_topics);
  if (left_out.contacts > 0)
    text += (text.empty() ? "" : ", and ") + counted(left_out.contacts, "contact");
  return text;
}

}  // namespace strake::bcf
