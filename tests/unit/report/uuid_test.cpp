// SPDX-License-Identifier: Apache-2.0
#include "report/text/uuid.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>

namespace strake::report {
namespace {

constexpr std::string_view kDns = "6ba7b810-9dad-11d1-80b4-00c04fd430c8";
constexpr std::string_view kUrl = "6ba7b811-9dad-11d1-80b4-00c04fd430c8";

TEST(Uuid, IsThatOfTheStandard) {
  // RFC 9562, A.4.
  EXPECT_EQ(uuid_from_key(kDns, "www.example.com"), "2ed6657d-e927-568b-95e1-2665a8aea6a2");
}

TEST(Uuid, IsThatOfAnotherImplementationAtEveryEndOfABlock) {
  // uuid.uuid5 of Python: with the name space 55, 56, 63, 64 and 128 bytes, and more.
  for (const auto& [length, uuid] : {std::pair{0, "4ebd0208-8328-5d69-8c44-ec50939c0967"},
                                     {39, "5824f981-4282-59d4-9716-acb6d741350e"},
                                     {40, "39f39c20-db47-5131-8879-62f8f67f9014"},
                                     {47, "660c273c-8a00-5941-b6f4-8d0afed88966"},
                                     {48, "7280cc42-274a-5c4a-91fc-ae23f853eeb7"},
                                     {112, "ab683ad5-4de4-5faf-bf37-0788e34176da"},
                                     {1000, "062a6b1a-ddc3-5fcc-b238-790846e533d6"}})
    EXPECT_EQ(uuid_from_key(kDns, std::string(static_cast<std::size_t>(length), 'a')), uuid);
  EXPECT_EQ(uuid_from_key(kUrl, "R\xC3\xB8r \xF0\x9F\x9A\xA2"),
            "f4aca05b-6dad-5142-8817-deb997aa740b");
}

TEST(Uuid, OfTheNameSpaceOfClashesIsThatOfItsUrl) {
  EXPECT_EQ(uuid_from_key(kUrl, "urn:strake:clash"), kClashNamespace);
}

TEST(Uuid, TakesTheNameSpaceInAnyWriting) {
  EXPECT_EQ(uuid_from_key("{6BA7B8109DAD11D180B400C04FD430C8}", "www.example.com"),
            uuid_from_key(kDns, "www.example.com"));
  EXPECT_NE(uuid_from_key(kUrl, "www.example.com"), uuid_from_key(kDns, "www.example.com"));
}

}  // namespace
}  // namespace strake::report
