// A robot whose sensors and wheels a companion simulates through the emulator's input and output.
#include "firmware/apps/pil_link/session.hpp"
#include "hal/board.hpp"

int main() {
  const whisker::hal::Board& board = whisker::hal::board();
  static whisker::link::Session session;
  return session.run(board.host, board.meter);
}
