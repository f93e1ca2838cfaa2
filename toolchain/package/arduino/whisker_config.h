/* The parts of the core. Both files of the core and all sketches include this; see firmware/part.hpp. */
#ifndef WHISKER_CONFIG_H
#define WHISKER_CONFIG_H

#ifdef __AVR__
/* What an ATmega1284P has room for. */
#define WHISKER_MAP_BYTES 0
#define WHISKER_EVASION 0
#define WHISKER_NARROW_GAPS 0
#define WHISKER_GYRO 0
#define WHISKER_INCIDENCE 0
#endif

#endif
