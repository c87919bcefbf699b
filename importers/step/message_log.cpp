// SPDX-License-Identifier: Apache-2.0
#include "message_log.hpp"

#include <Message.hxx>
#include <string_view>

#include "core/text_encoding.hpp"

namespace strake::import_step {

void FaultPrinter::send(const TCollection_AsciiString& text, Message_Gravity gravity) const {
  if (gravity < Message_Alarm || faults_.size() >= kMax) return;
  const std::string line = printable(trimmed(text.ToCString(), " \t\r\n*"));
  if (!line.empty()) faults_.push_back(line);
}

std::string failure_text(const Standard_Failure& failure) {
  const std::string_view kind = failure.DynamicType()->Name();
  constexpr std::string_view kSignal = "OSD_";
  if (kind.starts_with(kSignal))
    return "Open CASCADE has a fault there (" + std::string(kind.substr(kSignal.size())) + ")";
  const char* const message = failure.GetMessageString();
  return "Open CASCADE gives up (" + std::string(kind) +
         (message == nullptr || *message == 0 ? "" : ": " + printable(message)) + ")";
}

MessageLog::MessageLog() : printer_(new FaultPrinter) {
  Message::DefaultMessenger()->AddPrinter(printer_);
}

MessageLog::~MessageLog() { Message::DefaultMessenger()->RemovePrinter(printer_); }

std::string MessageLog::text() const {
  std::string all;
  for (const std::string& fault : printer_->faults()) all += (all.empty() ? "" : "; ") + fault;
  return all;
}

}  // namespace strake::import_step
