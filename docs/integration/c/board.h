/* The drivers of the simulated robot, as whisker.h wants them. */
#ifndef BOARD_H
#define BOARD_H

#include "firmware/c/whisker.h"
#include "plant.h"

/* The plant must outlive it. */
whisker_board plant_board(plant *p);

#endif
