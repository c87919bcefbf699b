// SPDX-License-Identifier: Apache-2.0
#include "message_log.hpp"

#include <Message.hxx>

#include "core/text_encoding.hpp"

namespace strake::import_step {

void FaultPrinter::send(const TCollection_AsciiString& text, Message_Gravity gravity) const {
  if (gravity < Message_Alarm || faults_.size() >= kMost) return;
  const std::string line = printable(trimmed(text.ToCString(), " \t\r\n*"));
  if (!line.empty()) faults_.push_back(line);
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
