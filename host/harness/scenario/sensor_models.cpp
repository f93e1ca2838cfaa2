#include "host/harness/scenario/sensor_models.hpp"

#include <string>

#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

constexpr double kNever = 1000;  // m, as far as any coordinate
constexpr double kNo = 0;        // of the light's keys: it does not matter

// The order is that of SensorModel: near and far cone; incidence; corner scatter; least and largest range;
// sigma and its share; soft range; reference reflectance; knee of the ambient light; what is lost;
// rate and latency. DS: the maker's data sheet. Range errors given as "+-x" are taken as two standard
// deviations (assumed).
constexpr SensorModel kModels[] = {
    {
        "hc-sr04",
        40,  // cone: a cylinder is detected up to 20-25 deg off the axis below 0.6 m (Parallax PING)))
             // product guide 2.0, a module of the same build; Dyrkacz, HC-SR04 beam tests, 2020)
        15,  // far cone: DS "effectual angle < 15 deg"; the same at 3 m in the tests that Dyrkacz cites
        40,  // incidence: up to 45 deg below 1 m, much less far away (the same); one figure for both: assumed
        0.5,     // corner scatter: assumed
        0.02,    // DS
        4.0,     // DS
        0.0015,  // DS: ranging accuracy 3 mm
        0.005,   // assumed: air temperature and gusts, 3 K change the speed of sound by 0.5 %
        0.5,     // soft targets: clothes and couch cloth are missed (user reports); the distance is assumed
        kNo, kNo, Lost::clear,
        16,     // DS: a measurement cycle of more than 60 ms
        0.025,  // the echo from 4 m takes 23 ms
    },
    {
        "us-100",
        40,      // as hc-sr04: the same transducers (assumed)
        15,      // resellers' sheets: 15 deg
        40,      // as hc-sr04
        0.5,     // assumed
        0.02,    // Adafruit's and resellers' sheets
        4.5,     // the same; Adafruit's driver notes no reading beyond 4.6 m
        0.0015,  // resellers' sheets: 0.3 cm + 1 %
        0.005,   // the same
        0.5,     // as hc-sr04
        kNo, kNo, Lost::clear,
        16,    // as hc-sr04
        0.03,  // the echo from 4.5 m takes 26 ms
    },
    {
        "maxbotix-mb1020",  // LV-MaxSonar-EZ2
        45,                 // near cone: the DS only draws it; wider near than far, 45 deg is assumed
        10,                 // far cone: the same, 10 deg is assumed
        40,                 // as hc-sr04 (assumed)
        0.5,                // assumed
        0.152,              // DS: objects nearer than 6 inches range as 6 inches
        6.45,               // DS: 254 inches
        0.0073,  // DS: resolution of 1 inch; 25.4 mm / sqrt(12), the error of rounding taken as noise
        0.005,   // as hc-sr04: no temperature compensation
        0.7,     // assumed: more power than hc-sr04
        kNo, kNo, Lost::clear,
        20,    // DS: a reading every 50 ms
        0.05,  // the same
    },
    {
        "maxbotix-mb1013",  // HRLV-MaxSonar-EZ1
        45,                 // near cone: as MB1020 (assumed)
        15,                 // far cone: assumed
        40,                 // as hc-sr04 (assumed)
        0.5,                // assumed
        0.3,                // DS: objects nearer than 30 cm range as 30 cm
        5.0,                // DS
        0.001,              // DS: 1 mm resolution
        0.005,              // DS: accuracy 1 %
        0.7,                // as MB1020
        kNo, kNo, Lost::clear,
        10,   // DS: a reading every 100 ms
        0.1,  // the same
    },
    {
        "vl53l0x",
        25,      // DS (DocID029104): full field of view 25 deg
        25,      // the same at every distance (assumed)
        80,      // matt surfaces scatter light at nearly every angle (assumed)
        kNever,  // assumed: as surfaces
        0.03,    // assumed; ArduPilot recommends 0.05
        2.0,     // DS: 200 cm, white 88 %, indoors
        0.002,   // assumed
        0.02,    // DS: 4 % at 1.2 m on white, indoors, as two standard deviations
        kNever,
        0.88,  // DS: the white chart; the law gives 0.88 m at 17 %, the DS 0.8 m
        0.13,  // fits the DS's 0.8 m on white in 5 klux; the law gives 0.35 m at 17 %, the DS 0.5 m
        Lost::clear,
        30,     // DS: a timing budget of 33 ms by default
        0.034,  // the same
    },
    {
        "vl53l1x",
        27,      // DS (DocID031281): typical full field of view 27 deg
        27,      // the same at every distance (assumed)
        80,      // as vl53l0x
        kNever,  // as vl53l0x
        0.04,    // ST, STEBCN2V1 user's manual: 40 mm
        3.6,     // the same: long mode, white 88 %, in the dark
        0.01,    // the same: +-20 mm in the dark
        0.0015,  // assumed
        kNever,
        0.88,  // the same; the law gives 1.58 m at 17 %, the manual 1.7 m
        0.17,  // fits 0.73 m on white in 200 kcps/SPAD, which is 100 klux if 10 kcps/SPAD are 5 klux as in
               // the DS of vl53l0x (assumed)
        Lost::clear,
        30,     // ST, UM2356: 33 ms, the least timing budget of the long mode
        0.034,  // the same
    },
    {
        "tfmini",
        2.3,     // DS (SJ-GU-TFmini-01): acceptance angle 2.3 deg
        2.3,     // the same
        80,      // as vl53l0x
        kNever,  // as vl53l0x
        0.3,     // DS
        12.0,    // DS: 90 % reflectivity, indoors
        0.0025,  // DS: resolution 5 mm
        0.005,   // DS: accuracy 1 % below 6 m
        kNever,
        0.9,            // DS; the law gives 4 m at 10 %, the DS 5 m
        9.2,            // fits 7 m at 90 % in 70 klux (DS)
        Lost::invalid,  // the frame holds the signal strength, and a low one means no distance (DS)
        100,            // DS
        0.01,           // assumed: one frame
    },
    {
        "gp2y0a21",
        5,       // about 5 deg (resellers' sheets)
        5,       // the same (assumed)
        75,      // a matt surface shows the spot at nearly every angle; less light than vl53l0x (assumed)
        kNever,  // as vl53l0x
        0.1,     // DS: nearer, the output falls again
        0.8,     // DS
        0.002,   // assumed
        0.02,    // assumed: the voltage falls with 1 / distance, so its noise grows with the distance
        kNever,
        kNo,  // DS: triangulation, little influence of the reflectance
        kNo,  // assumed: modulated light; the DS gives no figure
        Lost::clear,
        26,     // DS: a measurement takes 38.3 ms
        0.044,  // DS: and up to 5 ms until the output follows
        Near::farther,
    },
    {
        "gp2y0a41",
        5,       // as gp2y0a21
        5,       // the same
        75,      // as gp2y0a21
        kNever,  // as vl53l0x
        0.04,    // DS (OP13008EN)
        0.3,     // DS
        0.001,   // assumed
        0.02,    // as gp2y0a21
        kNever,
        kNo,  // DS: as gp2y0a21
        kNo,  // as gp2y0a21
        Lost::clear,
        60,     // DS: a measurement takes 16.5 ms
        0.022,  // DS: and up to 5 ms until the output follows
        Near::farther,
    },
};

constexpr struct {
  const char* alias;
  const char* name;
} kAliases[] = {
    {"maxbotix", "maxbotix-mb1020"}, {"mb1020", "maxbotix-mb1020"},  {"mb1013", "maxbotix-mb1013"},
    {"sharp-gp2y0a21", "gp2y0a21"},  {"sharp-gp2y0a41", "gp2y0a41"},
};

}  // namespace

std::vector<std::string_view> sensor_model_names() {
  std::vector<std::string_view> names;
  for (const SensorModel& m : kModels) names.emplace_back(m.name);
  for (const auto& a : kAliases) names.emplace_back(a.alias);
  return names;
}

const SensorModel* find_sensor_model(std::string_view spelt) {
  const std::string lower = lower_case(spelt);
  std::string_view name = lower;
  for (const auto& a : kAliases) {
    if (name == a.alias) name = a.name;
  }
  for (const SensorModel& m : kModels) {
    if (name == m.name) return &m;
  }
  return nullptr;
}

void apply(const SensorModel& model, Sensor& sensor) {
  sensor.model = model.name;
  sensor.cone_deg = model.cone_deg;
  sensor.cone_far_deg = model.cone_far_deg;
  sensor.incidence_deg = model.incidence_deg;
  sensor.corner_scatter_m = model.corner_scatter_m;
  sensor.min_range_m = model.min_range_m;
  sensor.max_range_m = model.max_range_m;
  sensor.sigma_m = model.sigma_m;
  sensor.sigma_share = model.sigma_share;
  sensor.soft_range_m = model.soft_range_m;
  sensor.reflectance_reference = model.reflectance_reference;
  sensor.ambient_knee_klux = model.ambient_knee_klux;
  sensor.lost_is = model.lost_is;
  sensor.near_is = model.near_is;
}

}  // namespace whisker
