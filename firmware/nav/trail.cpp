#include "firmware/nav/trail.hpp"

namespace whisker::nav {

using namespace literals;

void Trail::reset(Vec at, Length apart) noexcept {
  apart_ = apart;
  for (Vec& place : places_) place = at;
}

bool Trail::add(Vec at) noexcept {
  if (norm(at - places_[newest_]) <= apart_) return false;
  newest_ = static_cast<int8_t>((newest_ + 1) % kPlaces);
  places_[newest_] = at;
  return true;
}

Angle Trail::way_back(const Pose& pose) const noexcept {
  const Vec past = back(3) - pose.at;
  return norm(past) < apart_ * 3 / 2 ? pose.heading + 180_deg : bearing(past);
}

}  // namespace whisker::nav
