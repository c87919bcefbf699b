// SPDX-License-Identifier: Apache-2.0
// Golden files: what a topic is written as, to the byte.
#include "bcf/output/markup.hpp"

#include <gtest/gtest.h>

namespace strake::bcf {
namespace {

TopicFacts facts() {
  return {.guid = "d0094c1a-85e8-5a4f-a794-1be75c49d629",
          .title = "HIT, 18.0 mm deep: A&B / <C>",
          .status = "Reviewed",
          .priority = "High",
          .labels = {"HIT", "Piping"},
          .created = "2026-01-31T00:00:00Z",
          .author = "strake",
          .changed = "2026-02-01T10:00:00Z",
          .changer = "Ann",
          .assignee = "Bob",
          .description = "one\ntwo",
          .comments = {{"11111111-1111-4111-8111-111111111111", "2026-02-01T10:00:00Z", "Ann",
                        "move it"},
                       {"22222222-2222-4222-8222-222222222222", "2026-02-01T11:00:00Z", "Eve",
                        "edited", "2026-02-02T10:00:00Z", "Ann"}},
          .files = {{"a.ifc", "2026-01-30T10:00:00Z", "0$WU4A9R19$vKWO$AdOnKA"}, {"b.rvm"}}};
}

TEST(Markup, OfVersion21HasCommentsBehindTheTopic) {
  EXPECT_EQ(markup_file(facts(), {.viewpoint_guid = "eeb1bf3a-f4e8-5ed1-acfc-2f1cea528ac7"}),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<Markup>
  <Header>
    <File IfcProject="0$WU4A9R19$vKWO$AdOnKA">
      <Filename>a.ifc</Filename>
      <Date>2026-01-30T10:00:00Z</Date>
    </File>
    <File>
      <Filename>b.rvm</Filename>
    </File>
  </Header>
  <Topic Guid="d0094c1a-85e8-5a4f-a794-1be75c49d629" TopicType="Clash" TopicStatus="Reviewed">
    <Title>HIT, 18.0 mm deep: A&amp;B / &lt;C&gt;</Title>
    <Priority>High</Priority>
    <Labels>HIT</Labels>
    <Labels>Piping</Labels>
    <CreationDate>2026-01-31T00:00:00Z</CreationDate>
    <CreationAuthor>strake</CreationAuthor>
    <ModifiedDate>2026-02-01T10:00:00Z</ModifiedDate>
    <ModifiedAuthor>Ann</ModifiedAuthor>
    <AssignedTo>Bob</AssignedTo>
    <Description>one
two</Description>
  </Topic>
  <Comment Guid="11111111-1111-4111-8111-111111111111">
    <Date>2026-02-01T10:00:00Z</Date>
    <Author>Ann</Author>
    <Comment>move it</Comment>
  </Comment>
  <Comment Guid="22222222-2222-4222-8222-222222222222">
    <Date>2026-02-01T11:00:00Z</Date>
    <Author>Eve</Author>
    <Comment>edited</Comment>
    <ModifiedDate>2026-02-02T10:00:00Z</ModifiedDate>
    <ModifiedAuthor>Ann</ModifiedAuthor>
  </Comment>
  <Viewpoints Guid="eeb1bf3a-f4e8-5ed1-acfc-2f1cea528ac7">
    <Viewpoint>viewpoint.bcfv</Viewpoint>
    <Snapshot>snapshot.png</Snapshot>
    <Index>0</Index>
  </Viewpoints>
</Markup>
)");
}

TEST(Markup, OfVersion30HasAllWithinTheTopic) {
  TopicFacts plain = facts();
  plain.changed.clear();
  plain.assignee.clear();
  EXPECT_EQ(markup_file(plain, {.version_3 = true}),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<Markup>
  <Header>
    <Files>
      <File IfcProject="0$WU4A9R19$vKWO$AdOnKA">
        <Filename>a.ifc</Filename>
        <Date>2026-01-30T10:00:00Z</Date>
      </File>
      <File>
        <Filename>b.rvm</Filename>
      </File>
    </Files>
  </Header>
  <Topic Guid="d0094c1a-85e8-5a4f-a794-1be75c49d629" TopicType="Clash" TopicStatus="Reviewed">
    <Title>HIT, 18.0 mm deep: A&amp;B / &lt;C&gt;</Title>
    <Priority>High</Priority>
    <Labels>
      <Label>HIT</Label>
      <Label>Piping</Label>
    </Labels>
    <CreationDate>2026-01-31T00:00:00Z</CreationDate>
    <CreationAuthor>strake</CreationAuthor>
    <Description>one
two</Description>
    <Comments>
      <Comment Guid="11111111-1111-4111-8111-111111111111">
        <Date>2026-02-01T10:00:00Z</Date>
        <Author>Ann</Author>
        <Comment>move it</Comment>
      </Comment>
      <Comment Guid="22222222-2222-4222-8222-222222222222">
        <Date>2026-02-01T11:00:00Z</Date>
        <Author>Eve</Author>
        <Comment>edited</Comment>
        <ModifiedDate>2026-02-02T10:00:00Z</ModifiedDate>
        <ModifiedAuthor>Ann</ModifiedAuthor>
      </Comment>
    </Comments>
  </Topic>
</Markup>
)");
}

}  // namespace
}  // namespace strake::bcf
