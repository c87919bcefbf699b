// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Standard_Failure.hxx>
#include <string>
#include <vector>

namespace strake::import_step {

/// Keeps the first faults that Open CASCADE tells of, which its results do not say: the line of a
/// file that it does not understand.
class FaultPrinter : public Message_Printer {
 public:
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

 protected:
  void send(const TCollection_AsciiString& text, Message_Gravity gravity) const override;

 private:
  static constexpr std::size_t kMax = 3;

  // Open CASCADE tells printers in const functions.
  mutable std::vector<std::string> faults_;
};

/// Returns what went wrong in Open CASCADE, as messages say it.
[[nodiscard]] std::string failure_text(const Standard_Failure& failure);

/// Listens to Open CASCADE as long as it lives.
class MessageLog {
 public:
  MessageLog();
  ~MessageLog();
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;
  MessageLog(MessageLog&&) = delete;
  MessageLog& operator=(MessageLog&&) = delete;

  /// Returns what was reported, "; " between; empty where nothing was.
  [[nodiscard]] std::string text() const;

 private:
  Handle(FaultPrinter) printer_;
};

}  // namespace strake::import_step
