// SPDX-License-Identifier: Apache-2.0
#include "publish/form_words.hpp"

#include <optional>

#include "bcf/xml/xml_text.hpp"
#include "core/text/dates.hpp"
#include "core/text_encoding.hpp"

namespace strake::publish {

report::CsvForm csv_form(std::string_view word) {
  if (word == "excel") return {.separator = ',', .decimal = '.', .mark = true};
  if (word == "excel-comma") return {.separator = ';', .decimal = ',', .mark = true};
  return {};
}

report::ModelShown model_shown(std::string_view word) {
  if (word == "all") return report::ModelShown::all;
  if (word == "near") return report::ModelShown::near;
  if (word == "boxes") return report::ModelShown::boxes;
  return word == "none" ? report::ModelShown::nothing : report::ModelShown::automatic;
}

Status add_class(std::string_view word, report::WrittenClasses& classes) {
  if (word == "hit")
    classes.hit = true;
  else if (word == "contact")
    classes.contact = true;
  else if (word == "clearance" || word == "clearance_violation")
    classes.clearance_violation = true;
  else
    return Error{ErrorCode::usage, in_quotes(printable(word)) + " is no class", "",
                 "name one or several of hit,contact,clearance"};
  return {};
}

Result<std::string> bcf_date(const std::string& text) {
  std::optional<std::string> date = utc_of(text);
  if (!date) date = utc_of(text + "T00:00:00");
  if (date) return *date;
  return Error{ErrorCode::usage, in_quotes(printable(text)) + " is no date", "",
               "write it as 2026-01-31 or 2026-01-31T12:00:00Z"};
}

Result<std::string> bcf_author(const std::string& text) {
  std::string author = bcf::compared_text(text);
  if (!author.empty()) return author;
  return Error{ErrorCode::usage, "this is no name", "", "write who made the topics"};
}

}  // namespace strake::publish
