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

/// A selection and what messages call its position: "steel.toml, line 7: [sets] 'hull'".
struct Chooser {
  model::Selection selection;
  std::string where;
};

struct NamedSet {
  std::string name;
  Chooser chooser;
};

/// The [sets] of a file: selections that name each other in any order, but not in a cycle.
class NamedSets {
 public:
  /// Takes the table of sets; null: there are none.
  NamedSets(ParseContext& reading, const Value* table);

  /// Returns a selection of the file, which may name sets; one that makes no sense is a fault of
  /// the parsing.
  std::optional<Chooser> chooser(const Value& value, const std::string& what);
  /// Returns the selection at a key of a table, if the key is there.
  std::optional<Chooser> chooser(TableReader& table, std::string_view key);
  /// Returns the selection at a key of a table, which must be there.
  std::optional<Chooser> required(TableReader& table, std::string_view key);

  /// Returns all sets, in the order of the file.
  std::vector<NamedSet> all();

 private:
  struct Set {
    const KeyValue* entry = nullptr;
    std::optional<model::Selection> selection;
    bool open = false;  ///< it is being evaluated
  };
  Result<model::Selection> find(std::string_view name);
  Result<model::Selection> parse(const Value& value, const std::string& what);

  ParseContext& reading_;
  std::vector<Set> sets_;
  int depth_ = 0;
};

}  // namespace strake::settings
