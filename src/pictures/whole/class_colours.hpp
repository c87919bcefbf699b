// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pictures/clash_picture.hpp"

namespace strake::pictures {

/// The colour of a class, distinguished by all who see colours (Okabe and Ito).
[[nodiscard]] constexpr Colour colour_of_class(clash::Class cls) {
  switch (cls) {
    case clash::Class::hit:
      return {0xd5, 0x5e, 0x00};
    case clash::Class::clearance_violation:
      return {0x00, 0x72, 0xb2};
    case clash::Class::contact:
      return {0x00, 0x9e, 0x73};
    case clash::Class::no_hit:
      break;
  }
  return {0x8c, 0x8c, 0x8c};
}

/// How bad a class is to people: a contact is mostly meant.
[[nodiscard]] constexpr int severity(clash::Class cls) {
  switch (cls) {
    case clash::Class::hit:
      return 3;
    case clash::Class::clearance_violation:
      return 2;
    case clash::Class::contact:
      return 1;
    case clash::Class::no_hit:
      break;
  }
  return 0;
}

/// Returns the worst class of each object among results that no rule allows.
[[nodiscard]] inline std::vector<clash::Class> worst_classes(
    const report::ClashContents& contents) {
  std::vector<clash::Class> worst(contents.model.objects.size(), clash::Class::no_hit);
  for (const clash::Report& test : contents.findings.tests)
    for (const clash::Pair& pair : test.pairs) {
      if (pair.allowed >= 0) continue;
      for (const model::ObjectId id : {pair.a, pair.b})
        if (clash::Class& known = worst[index(id)]; severity(pair.cls) > severity(known))
          known = pair.cls;
    }
  return worst;
}

}  // namespace strake::pictures
