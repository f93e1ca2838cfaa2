/* What of the core is built: may define WHISKER_GYRO (firmware/part.hpp) and WHISKER_MAP_BYTES. Both files of
   the core and all sketches include this. */
#ifndef WHISKER_CONFIG_H
#define WHISKER_CONFIG_H
#endif
