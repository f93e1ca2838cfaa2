// A robot whose sensors and wheels a companion simulates at the other end of a serial line.
#include "firmware/apps/pil_link/session.hpp"
#include "hal/board.hpp"

int main() {
  const whisker::hal::Board& board = whisker::hal::board();
  static whisker::link::Session session;
  return session.run(board.serial, board.meter);
}
