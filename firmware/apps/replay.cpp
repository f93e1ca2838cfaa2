// Plays the golden streams: a robot whose sensors and wheels answer as recorded.
#include "firmware/apps/golden/player.hpp"

int main() { return whisker::golden::play(whisker::hal::board().meter); }
