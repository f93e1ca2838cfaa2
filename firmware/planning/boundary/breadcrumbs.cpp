#include "firmware/planning/boundary/breadcrumbs.hpp"

namespace whisker::planning {

using namespace literals;

void Breadcrumbs::reset(Vec at, Length apart) noexcept {
  apart_ = apart;
  for (Vec& place : places_) place = at;
}

bool Breadcrumbs::add(Vec at) noexcept {
  if (norm(at - places_[newest_]) <= apart_) return false;
  newest_ = static_cast<int8_t>((newest_ + 1) % kPlaces);
  places_[newest_] = at;
  return true;
}

Angle Breadcrumbs::way_back(const Pose& pose) const noexcept {
  const Vec past = back(3) - pose.at;
  return norm(past) < apart_ * 3 / 2 ? pose.heading + 180_deg : bearing(past);
}

}  // namespace whisker::planning
