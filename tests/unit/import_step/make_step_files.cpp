// SPDX-License-Identifier: Apache-2.0

// make_step_files FOLDER: the models of the tests, for scripts that run the program on them.
#include <Message.hxx>
#include <Message_Messenger.hxx>

#include "unit/import_step/step_files.hpp"

int main(int count, char** words) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  return count == 2 && strake::import_step::write_step_files(words[1]) ? 0 : 1;
}
