/* The core for C: a robot with the default planner of the build, and the guard alone. C99 and C++.
 *
 *   static whisker_robot robot;                 a fixed size, no heap
 *   whisker_params params;
 *   whisker_default_params(&params);
 *   whisker_set_param(&params, WHISKER_PARAM_BODY_RADIUS, 75000);
 *   whisker_create(&robot, &params, &board);    board: your functions
 *   whisker_place(&robot, 0, 0, 0);
 *   whisker_set_goal(&robot, 4000000, 1000000, 100000);
 *   every 10 ms:  whisker_tick(&robot, now_ms, &status);
 *
 * or, without a planner, with your own velocity commands (the guard alone, below):
 *   whisker_guard_create(&guard, &params, &board);
 *   whisker_guard_command(&guard, 200000, 500000, now_ms);
 *   every 10 ms:  whisker_guard_tick(&guard, now_ms, &status);
 *
 * Lengths are in um, headings in 2^-32 turn, counter-clockwise positive; whisker_heading() converts degrees.
 * Places lie within 1,000 m of the origin along each axis. A failure stops the wheels until whisker_reset();
 * whisker_status.fault names it. firmware/robot.hpp and hal/ describe all in detail. */
#ifndef WHISKER_H
#define WHISKER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Parameters */

/* A set of parameters; see enum whisker_param. */
#define WHISKER_PARAM_ROOM 96
typedef struct whisker_params {
  uint32_t words[WHISKER_PARAM_ROOM];
} whisker_params;

/* The keys of a robot file, without their units. The comment: unit of the value 1, default, range. */
enum whisker_param {
  /* params:begin */
  WHISKER_PARAM_BODY_RADIUS,                  /* um; 90000; 20000 to 1000000 */
  WHISKER_PARAM_BODY_MARGIN,                  /* um; 30000; 0 to 500000 */
  WHISKER_PARAM_WHEEL_TRACK,                  /* um; 140000; 20000 to 2000000 */
  WHISKER_PARAM_WHEEL_SPEED_MAX,              /* um/s; 300000; 20000 to 3200000 */
  WHISKER_PARAM_WHEEL_ACCELERATION_MAX,       /* um/s2; 1000000; 50000 to 20000000 */
  WHISKER_PARAM_TURN_RATE_MAX,                /* urad/s; 3000000; 100000 to 20000000 */
  WHISKER_PARAM_MOTOR_LAG,                    /* ms; 50; 0 to 500 */
  WHISKER_PARAM_ENCODER_COUNTS_PER_M,         /* 1; 5000; 100 to 1000000 */
  WHISKER_PARAM_RANGE_SIDE_ANGLE,             /* 2^-32 turn; 357913941; 59652324 to 1014089500 */
  WHISKER_PARAM_RANGE_CONE,                   /* 2^-32 turn; 298261618; 11930465 to 1073741824 */
  WHISKER_PARAM_RANGE_MIN,                    /* um; 20000; 0 to 1000000 */
  WHISKER_PARAM_RANGE_MAX,                    /* um; 2000000; 200000 to 60000000 */
  WHISKER_PARAM_RANGE_OFFSET,                 /* um; 0; 0 to 1000000 */
  WHISKER_PARAM_RANGE_RATE_HZ,                /* 1; 50; 5 to 100 */
  WHISKER_PARAM_RANGE_LATENCY,                /* ms; 20; 0 to 200 */
  WHISKER_PARAM_CONSENSUS,                    /* choice; 0; 0 to 1 */
  WHISKER_PARAM_CONSENSUS_READS,              /* derived: cannot be set */
  WHISKER_PARAM_CONSENSUS_TOLERANCE,          /* derived: cannot be set */
  WHISKER_PARAM_STALE_AFTER,                  /* ms; 100; 20 to 2000 */
  WHISKER_PARAM_STUCK_TURN,                   /* derived: cannot be set */
  WHISKER_PARAM_THESIS_DISTANCE,              /* derived: cannot be set */
  WHISKER_PARAM_THESIS_BASE_TURN,             /* derived: cannot be set */
  WHISKER_PARAM_THESIS_BASE_STEP,             /* derived: cannot be set */
  WHISKER_PARAM_THESIS_SMALL_STEP,            /* derived: cannot be set */
  WHISKER_PARAM_THESIS_DELTA,                 /* derived: cannot be set */
  WHISKER_PARAM_THESIS_DANGER_RANGE,          /* derived: cannot be set */
  WHISKER_PARAM_THESIS_MAX_STEPS,             /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_CELL,                   /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_PROBE,                  /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_SHIELD_MARGIN,          /* um; 4000; 0 to 500000 */
  WHISKER_PARAM_SKIRT_PLANNING_MARGIN,        /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_AGE_TRAVEL,             /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_AGE_TURN,               /* derived: cannot be set */
  WHISKER_PARAM_SKIRT_MOVER_SPEED,            /* derived: cannot be set */
  WHISKER_PARAM_MOTION_SETTLE,                /* derived: cannot be set */
  WHISKER_PARAM_TURN_TOLERANCE,               /* derived: cannot be set */
  WHISKER_PARAM_DRIVE_TOLERANCE,              /* derived: cannot be set */
  WHISKER_PARAM_CONTROL_PERIOD,               /* ms; 10; 5 to 50 */
  WHISKER_PARAM_MAX_TICK_GAP,                 /* ms; 0; 0 to 250 */
  WHISKER_PARAM_LOST_AFTER,                   /* derived: cannot be set */
  WHISKER_PARAM_WHEELS_STALLED_AFTER,         /* derived: cannot be set */
  WHISKER_PARAM_MAX_DRIVE_REFUSALS,           /* derived: cannot be set */
  WHISKER_PARAM_RANGE_CLEAR,                  /* um; 0; 0 to 60000000 */
  WHISKER_PARAM_LENGTH_BUDGET,                /* um; 400000000; 1000000 to 2000000000 */
  WHISKER_PARAM_RANGE_INCIDENCE,              /* 2^-32 turn; 1073741824; 59652324 to 1073741824 */
  WHISKER_PARAM_RANGE_LEFT_X,                 /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_LEFT_Y,                 /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_LEFT_ANGLE,             /* 2^-32 turn; 0; -1014089500 to 1014089500 */
  WHISKER_PARAM_RANGE_LEFT_CONE,              /* 2^-32 turn; 0; 0 to 1073741824 */
  WHISKER_PARAM_RANGE_LEFT_MIN,               /* derived: cannot be set */
  WHISKER_PARAM_RANGE_LEFT_MAX,               /* derived: cannot be set */
  WHISKER_PARAM_RANGE_FRONT_X,                /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_FRONT_Y,                /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_FRONT_ANGLE,            /* 2^-32 turn; 0; -1014089500 to 1014089500 */
  WHISKER_PARAM_RANGE_FRONT_CONE,             /* 2^-32 turn; 0; 0 to 1073741824 */
  WHISKER_PARAM_RANGE_FRONT_MIN,              /* derived: cannot be set */
  WHISKER_PARAM_RANGE_FRONT_MAX,              /* derived: cannot be set */
  WHISKER_PARAM_RANGE_RIGHT_X,                /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_RIGHT_Y,                /* um; 0; -1000000 to 1000000 */
  WHISKER_PARAM_RANGE_RIGHT_ANGLE,            /* 2^-32 turn; 0; -1014089500 to 1014089500 */
  WHISKER_PARAM_RANGE_RIGHT_CONE,             /* 2^-32 turn; 0; 0 to 1073741824 */
  WHISKER_PARAM_RANGE_RIGHT_MIN,              /* derived: cannot be set */
  WHISKER_PARAM_RANGE_RIGHT_MAX,              /* derived: cannot be set */
  WHISKER_PARAM_BUMPER,                       /* choice; 0; 0 to 1 */
  WHISKER_PARAM_CREEP_SPEED,                  /* um/s; 0; 0 to 100000 */
  WHISKER_PARAM_GYRO,                         /* choice; 0; 0 to 1 */
  WHISKER_PARAM_GYRO_RATE_HZ,                 /* 1; 100; 20 to 1000 */
  WHISKER_PARAM_GYRO_RANGE,                   /* urad/s; 8726646; 1000000 to 40000000 */
  WHISKER_PARAM_GYRO_SCALE,                   /* 1e-6; 1000000; 800000 to 1250000 */
  WHISKER_PARAM_WHEEL_SCALE_SIGMA,            /* 1e-6; 0; 0 to 100000 */
  WHISKER_PARAM_WHEEL_SCALE_COMMON_SIGMA,     /* 1e-6; 0; 0 to 100000 */
  WHISKER_PARAM_HEADING_DRIFT_DEG_PER_SQRT_M, /* 2^-32 turn; 0; 0 to 59652324 */
  WHISKER_PARAM_GYRO_SCALE_SIGMA,             /* 1e-6; 10000; 0 to 100000 */
  WHISKER_PARAM_GYRO_WALK_DEG_PER_SQRT_H,     /* 2^-32 turn; 4772186; 0 to 119304647 */
  WHISKER_PARAM_GYRO_WARM_UP_DPS,             /* 2^-32 turn; 1193046; 0 to 11930465 */
  WHISKER_PARAM_FIX_JUMPS,                    /* choice; 0; 0 to 1 */
  WHISKER_PARAM_WHEEL_RATIO,                  /* 1e-6; 1000000; 900000 to 1100000 */
  WHISKER_PARAM_COMMAND_TIMEOUT,              /* ms; 250; 20 to 2000 */
  WHISKER_PARAM_GUARD_NODS,                   /* choice; 1; 0 to 1 */
  WHISKER_PARAM_GUARD_ASSIST,                 /* choice; 1; 0 to 1 */
  WHISKER_PARAM_STRAIGHT_WALLS,               /* choice; 0; 0 to 1 */
  WHISKER_PARAM_WALL_DIRECTION,               /* 2^-32 turn; 0; 0 to 1073741824 */
  WHISKER_PARAM_BEND_COURSE,                  /* choice; 1; 0 to 1 */
  WHISKER_PARAM_SONAR                         /* choice; 0; 0 to 1 */
  /* params:end */
};

/* The reference robot. */
void whisker_default_params(whisker_params* params);
/* A negative value is converted to uint32_t. False: there is no such parameter, or the value is outside its
 * range; nothing changed. */
bool whisker_set_param(whisker_params* params, enum whisker_param which, uint32_t value);
/* 0 if there is no such parameter. */
uint32_t whisker_get_param(const whisker_params* params, enum whisker_param which);
/* The first relation between parameters that the set violates; 0: none. */
uint8_t whisker_check_params(const whisker_params* params);
/* Its name, for example "track_wider_than_body". */
const char* whisker_param_fault_name(uint8_t fault);
/* 2^-32 turn from thousandths of a degree; |millidegrees| < 2^30. */
uint32_t whisker_heading(int32_t millidegrees);

/* ---- Your hardware */

enum whisker_range_status {
  WHISKER_RANGE_OK,       /* mm is a distance; from the maximum range on it counts as clear */
  WHISKER_RANGE_CLEAR,    /* no echo from within the maximum range; mm is not used */
  WHISKER_RANGE_TOO_NEAR, /* nearer than the minimum range; mm is not used */
  WHISKER_RANGE_INVALID,  /* the reading is lost, or the sensor does not answer */
  WHISKER_RANGE_STALE     /* no new reading */
};

/* The latest measurement of a rangefinder; hal/types.hpp. */
typedef struct whisker_range {
  uint16_t mm;      /* from the apex of the sensor; at most 65533 */
  uint8_t status;   /* enum whisker_range_status */
  uint8_t age_ms;   /* since the distance was true; 255: that or more */
  uint8_t sequence; /* increases by one with every new measurement, modulo 16 */
} whisker_range;

/* The samples of a yaw-rate gyro since power-up; hal/types.hpp. */
typedef struct whisker_gyro {
  uint32_t sum;       /* of all samples, modulo 2^32 */
  uint16_t samples;   /* their number, modulo 2^16 */
  uint16_t saturated; /* of them at the limit of the chip's range, modulo 2^16 */
} whisker_gyro;

/* The drivers. The core calls each once per tick, with `user` as the first argument. None may block. False:
 * refused. */
typedef struct whisker_board {
  void* user;
  /* Left, front, right. */
  bool (*ranges)(void* user, whisker_range readings[3]);
  /* Encoder counts since power-up, modulo 2^24, forward positive. */
  bool (*counts)(void* user, uint32_t* left, uint32_t* right);
  /* Sets the speeds of the wheel rims in 0.1 mm/s, forward positive; they hold until the next call. */
  bool (*speeds)(void* user, int16_t left, int16_t right);
  /* Bump switches: bit 0 left, 1 front, 2 right. Null: none. Used if WHISKER_PARAM_BUMPER is 1. */
  bool (*bumper)(void* user, uint8_t* pressed);
  /* Null: none. Used if WHISKER_PARAM_GYRO is 1. */
  bool (*gyro)(void* user, whisker_gyro* reading);
} whisker_board;

/* ---- The robot */

/* Room for a robot with its parameters and its planner. The library does not compile if it is too small.
 * Definitions of the build, such as WHISKER_MAP_BYTES, must be the same for the library and the program. A
 * robot must not be copied. */
#ifndef WHISKER_ROBOT_BYTES
#if defined(WHISKER_DEFAULT_MAP_BYTES)
#define WHISKER_ROBOT_BYTES (5120 + WHISKER_DEFAULT_MAP_BYTES)
#elif defined(WHISKER_MAP_BYTES) && WHISKER_MAP_BYTES < 2048
#define WHISKER_ROBOT_BYTES 5120
#else
#define WHISKER_ROBOT_BYTES 7168
#endif
#endif
typedef struct whisker_robot {
  uint64_t words[WHISKER_ROBOT_BYTES / 8];
} whisker_robot;

enum whisker_outcome {
  WHISKER_OUTCOME_NONE, /* no goal */
  WHISKER_OUTCOME_RUNNING,
  WHISKER_OUTCOME_REACHED,
  WHISKER_OUTCOME_UNREACHABLE,
  WHISKER_OUTCOME_GAVE_UP
};

/* The result of a tick. */
typedef struct whisker_status {
  int32_t x_um;            /* the estimated pose */
  int32_t y_um;            /* */
  uint32_t heading;        /* 2^-32 turn */
  uint32_t sigma_along_um; /* standard deviations of the pose; 0 if the parameters declare no error of the
                              wheels */
  uint32_t sigma_across_um;
  uint32_t sigma_heading; /* 2^-32 turn */
  int16_t left;           /* the command of the wheels, 0.1 mm/s */
  int16_t right;
  uint8_t outcome; /* enum whisker_outcome */
  uint8_t mode;    /* what the robot does: whisker_mode_name() */
  uint8_t why;     /* and why: whisker_why_name() */
  uint8_t fault;   /* why it stands until whisker_reset(); 0: no fault: whisker_fault_name() */
  uint8_t pressed; /* bump switches */
} whisker_status;

/* Makes a robot; the parameters and the board are copied, `user` must outlive it. False: the functions for
 * ranges, counts or speeds are missing, and no other function may be called. Parameters that
 * whisker_check_params() refuses are a fault of the robot. */
bool whisker_create(whisker_robot* robot, const whisker_params* params, const whisker_board* board);
/* Robot::place: the robot was put down there or, with an active goal, is there. False: beyond the limit,
 * which is a fault. */
bool whisker_place(whisker_robot* robot, int32_t x_um, int32_t y_um, uint32_t heading);
/* Robot::correct: a fix from outside that is true at the counts of the last tick, with its standard
 * deviations in um and 2^-32 turn. False: refused, or beyond the limit. */
bool whisker_correct(whisker_robot* robot, int32_t x_um, int32_t y_um, uint32_t heading, int32_t sigma_um,
                     uint32_t sigma_heading);
/* Robot::set_goal. False: the goal lies beyond the limit, or its tolerance is smaller than the robot keeps;
 * the status says which, and the current mission ends. */
bool whisker_set_goal(whisker_robot* robot, int32_t x_um, int32_t y_um, int32_t tolerance_um);
void whisker_cancel(whisker_robot* robot);
/* Ends a fault. Set the goal again. */
void whisker_reset(whisker_robot* robot);
/* One control tick, every WHISKER_PARAM_CONTROL_PERIOD. now_ms wraps. The status may be null. */
void whisker_tick(whisker_robot* robot, uint32_t now_ms, whisker_status* status);
/* The result of the last tick. */
void whisker_get_status(const whisker_robot* robot, whisker_status* status);

/* ---- The guard alone: any velocity command in, safe wheel speeds out (docs/guard.md) */

/* Room for a guard with its parameters; otherwise like whisker_robot. */
#ifndef WHISKER_GUARD_BYTES
#define WHISKER_GUARD_BYTES 4096
#endif
typedef struct whisker_guard {
  uint64_t words[WHISKER_GUARD_BYTES / 8];
} whisker_guard;

/* Why the wheels do what they do; firmware/guard.hpp. */
enum whisker_guard_reason {
  WHISKER_GUARD_CLEAR, /* the command is granted in full */
  WHISKER_GUARD_FAULT, /* whisker_guard_status.fault names it */
  WHISKER_GUARD_STALE_RANGES,
  WHISKER_GUARD_COMMAND_TIMEOUT,
  WHISKER_GUARD_NODDING, /* a beam turns onto unseen ground, or back */
  WHISKER_GUARD_OBSTACLE,
  WHISKER_GUARD_UNSEEN,
  WHISKER_GUARD_DOUBT,   /* the readings or the sensors leave doubt about clear ground */
  WHISKER_GUARD_LIMITS,  /* the command exceeds what the wheels can do */
  WHISKER_GUARD_ASSISTED /* the response table bends or slows it */
};

/* The result of a tick. The pose, which begins at zero, and its standard deviations are those of
 * whisker_status. */
typedef struct whisker_guard_status {
  int32_t x_um;
  int32_t y_um;
  uint32_t heading;
  uint32_t sigma_along_um;
  uint32_t sigma_across_um;
  uint32_t sigma_heading;
  int32_t asked_forward;    /* the last command, um/s; 0 after WHISKER_PARAM_COMMAND_TIMEOUT */
  int32_t asked_turning;    /* urad/s */
  uint16_t granted_forward; /* share of the asked forward speed, 0 to 16384 */
  uint16_t granted_turning; /* of the turning */
  int16_t left;             /* the command of the wheels, 0.1 mm/s */
  int16_t right;
  uint8_t reason; /* enum whisker_guard_reason; whisker_guard_reason_name() */
  uint8_t fault;  /* why it stands until whisker_guard_reset(); 0: no fault: whisker_fault_name() */
} whisker_guard_status;

/* Makes a guard; otherwise like whisker_create(). It uses no bump switches. Parameters that
 * whisker_check_params() refuses, or with a creep speed, are a fault. */
bool whisker_guard_create(whisker_guard* guard, const whisker_params* params, const whisker_board* board);
/* The velocity of the body until the next command, at most for WHISKER_PARAM_COMMAND_TIMEOUT. Any value is
 * safe. forward: um/s, negative: backwards; turning: urad/s, counter-clockwise positive; now_ms: by the clock
 * of whisker_guard_tick(). */
void whisker_guard_command(whisker_guard* guard, int32_t forward, int32_t turning, uint32_t now_ms);
/* Guard::vouch: nothing stands within this distance of the body's centre; 0 or less: nothing is said. */
void whisker_guard_vouch(whisker_guard* guard, int32_t radius_um);
/* Ends a fault, and drops the command and all that was seen. */
void whisker_guard_reset(whisker_guard* guard);
/* One control tick, every WHISKER_PARAM_CONTROL_PERIOD. now_ms wraps. The status may be null. */
void whisker_guard_tick(whisker_guard* guard, uint32_t now_ms, whisker_guard_status* status);
/* The result of the last tick. */
void whisker_guard_get_status(const whisker_guard* guard, whisker_guard_status* status);

const char* whisker_guard_reason_name(uint8_t reason);

/* ---- Names */

const char* whisker_fault_name(uint8_t fault);
const char* whisker_mode_name(uint8_t mode);
const char* whisker_why_name(uint8_t why);

#ifdef __cplusplus
}
#endif

#endif
