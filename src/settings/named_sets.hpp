// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "settings/table_reader.hpp"
#include "strake/core/result.hpp"
#include "strake/model/selection.hpp"

namespace strake::settings {

/// A selection and what messages call its place: "steel.toml, line 7: [sets] 'hull'".
struct Chooser {
  model::Selection selection;
  std::string where;
};

struct NamedSet {
  std::string name;
  Chooser chooser;
};

/// The [sets] of a file: selections that name each other in any order, but not in a circle.
class NamedSets {
 public:
  /// `table` may be null: no sets.
  NamedSets(ParseContext& reading, const Value* table);

  /// A selection of the file, which may name sets; a fault of the reading where it makes no sense.
  std::optional<Chooser> chooser(const Value& value, const std::string& what);
  /// The key of a table, where it is there.
  std::optional<Chooser> chooser(TableReader& table, std::string_view key);
  /// The key of a table, which must be there.
  std::optional<Chooser> required(TableReader& table, std::string_view key);

  /// All sets, in the order of the file.
  std::vector<NamedSet> all();

 private:
  struct Set {
    const KeyValue* entry = nullptr;
    std::optional<model::Selection> selection;
    bool open = false;  ///< being worked out
  };
  Result<model::Selection> find(std::string_view name);
  Result<model::Selection> parse(const Value& value, const std::string& what);

  ParseContext& reading_;
  std::vector<Set> sets_;
  int depth_ = 0;
};

}  // namespace strake::settings
