// SPDX-License-Identifier: Apache-2.0
#include "bcf/output/markup.hpp"

#include "bcf/topics/words.hpp"
#include "bcf/xml/xml_text.hpp"

namespace strake::bcf {
namespace {

/// The order of elements is that of the schemas, which say so of both versions.
class MarkupWriter {
 public:
  MarkupWriter(const TopicFacts& facts, const MarkupForm& form)
      : facts_(facts), form_(form), xml_("Markup") {}

  std::string write() {
    header();
    xml_.begin("Topic").attribute("Guid", facts_.guid);
    xml_.attribute("TopicType", kTopicType).attribute("TopicStatus", facts_.status);
    topic();
    // Comments and viewpoints are within the topic from 3.0 on, before that they are behind it.
    if (!form_.version_3) xml_.end();
    comments();
    viewpoint();
    return xml_.finish();
  }

 private:
  void header() {
    xml_.begin("Header");
    if (form_.version_3) xml_.begin("Files");
    for (const TopicFile& file : facts_.files) {
      xml_.begin("File");
      if (!file.project.empty()) xml_.attribute("IfcProject", file.project);
      xml_.leaf_if("Filename", file.name).leaf_if("Date", file.date).end();
    }
    if (form_.version_3) xml_.end();
    xml_.end();
  }

  void topic() {
    xml_.leaf("Title", facts_.title).leaf("Priority", facts_.priority);
    if (form_.version_3) xml_.begin("Labels");
    for (const std::string& label : facts_.labels)
      xml_.leaf_if(form_.version_3 ? "Label" : "Labels", label);
    if (form_.version_3) xml_.end();
    xml_.leaf("CreationDate", facts_.created).leaf("CreationAuthor", facts_.author);
    if (!facts_.changed.empty())
      xml_.leaf("ModifiedDate", facts_.changed).leaf_if("ModifiedAuthor", facts_.changer);
    xml_.leaf_if("AssignedTo", facts_.assignee).leaf("Description", facts_.description);
  }

  void comments() {
    if (form_.version_3) xml_.begin("Comments");
    for (const TopicComment& comment : facts_.comments) {
      xml_.begin("Comment").attribute("Guid", comment.guid);
      xml_.leaf("Date", comment.date).leaf("Author", comment.author);
      // The schema of 2.1 requests the element, that of 3.0 for a text in it.
      if (form_.version_3)
        xml_.leaf_if("Comment", comment.text);
      else
        xml_.leaf("Comment", comment.text);
      if (!comment.changed.empty())
        xml_.leaf("ModifiedDate", comment.changed).leaf("ModifiedAuthor", comment.changer);
      xml_.end();
    }
    if (form_.version_3) xml_.end();
  }

  void viewpoint() {
    if (form_.viewpoint_guid.empty()) return;
    if (form_.version_3) xml_.begin("Viewpoints");
    xml_.begin(form_.version_3 ? "ViewPoint" : "Viewpoints");
    xml_.attribute("Guid", form_.viewpoint_guid);
    xml_.leaf("Viewpoint", kViewpointFile).leaf("Snapshot", kSnapshotFile).leaf("Index", "0");
    xml_.end();
    if (form_.version_3) xml_.end();
  }

  const TopicFacts& facts_;
  const MarkupForm& form_;
  XmlWriter xml_;
};

}  // namespace

std::string markup_file(const TopicFacts& facts, const MarkupForm& form) {
  return MarkupWriter(facts, form).write();
}

}  // namespace strake::bcf
