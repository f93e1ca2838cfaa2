#include "world.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

b2Vec2 point(const toml::node_view<toml::node>& node) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) throw std::runtime_error("a point must have two coordinates");
  return {pair->get(0)->value<float>().value(), pair->get(1)->value<float>().value()};
}

std::vector<b2Vec2> points(toml::table& table) {
  std::vector<b2Vec2> out;
  for (toml::node& node : *table["points"].as_array())
    out.push_back(point(toml::node_view<toml::node>(node)));
  return out;
}

void line(b2Body& ground, const std::vector<b2Vec2>& corners, bool closed) {
  for (std::size_t i = 0; i + 1 < corners.size() + (closed ? 1 : 0); ++i) {
    b2EdgeShape edge;
    edge.m_radius = 0;  // no skin
    edge.SetTwoSided(corners[i], corners[(i + 1) % corners.size()]);
    ground.CreateFixture(&edge, 0);
  }
}

// Takes the part of the segment inside the cone, whose edges are half planes; false: none.
bool clip(b2Vec2& a, b2Vec2& b, float axis, float half) {
  for (const float side : {1.0F, -1.0F}) {
    const float edge = axis + side * half;
    const b2Vec2 inward(side * std::sin(edge), -side * std::cos(edge));
    const float da = b2Dot(inward, a), db = b2Dot(inward, b);
    if (da < 0 && db < 0) return false;
    if (da < 0) a = a + (da / (da - db)) * (b - a);
    if (db < 0) b = b + (db / (db - da)) * (a - b);
  }
  return true;
}

// From the origin.
float nearest_of_segment(b2Vec2 a, b2Vec2 b, float axis, float half) {
  if (!clip(a, b, axis, half)) return std::numeric_limits<float>::infinity();
  const b2Vec2 d = b - a;
  const float part = d.LengthSquared() > 0 ? b2Clamp(-b2Dot(a, d) / d.LengthSquared(), 0.0F, 1.0F) : 0;
  return (a + part * d).Length();
}

float nearest_of_disc(b2Vec2 centre, float radius, float axis, float half) {
  const float far = centre.Length();
  const float off = std::abs(std::remainder(std::atan2(centre.y, centre.x) - axis, 2 * b2_pi));
  const float beside = off - half;
  if (beside <= 0) return far - radius;
  const float aside = far * std::sin(beside), ahead = far * std::cos(beside);
  if (ahead <= 0 || aside >= radius) return std::numeric_limits<float>::infinity();
  return ahead - std::sqrt(radius * radius - aside * aside);
}

}  // namespace

Scenario load(const std::string& file, b2World& world) {
  toml::table table = toml::parse_file(file);
  Scenario s;
  s.start = {table["start"]["x_m"].value_or(0.0F), table["start"]["y_m"].value_or(0.0F)};
  s.goal = {table["goal"]["x_m"].value_or(0.0F), table["goal"]["y_m"].value_or(0.0F)};
  s.tolerance = table["goal"]["tolerance_m"].value_or(0.1F);
  const b2Vec2 to_goal = s.goal - s.start;
  s.heading =
      table["start"]["heading_deg"].value_or(std::atan2(to_goal.y, to_goal.x) * 180 / b2_pi) * b2_pi / 180;
  b2BodyDef fixed;
  b2Body& ground = *world.CreateBody(&fixed);
  if (table.contains("bounds")) {
    const b2Vec2 low = point(table["bounds"]["min"]), high = point(table["bounds"]["max"]);
    line(ground, {low, {high.x, low.y}, high, {low.x, high.y}}, true);
  }
  const auto each = [&](const char* key, const auto& make) {
    if (toml::array* list = table[key].as_array()) {
      for (toml::node& node : *list) make(*node.as_table());
    }
  };
  each("disc", [&](toml::table& disc) {
    b2CircleShape circle;
    circle.m_p = point(disc["center"]);
    circle.m_radius = disc["radius_m"].value<float>().value();
    ground.CreateFixture(&circle, 0);
  });
  each("polygon", [&](toml::table& polygon) { line(ground, points(polygon), true); });
  each("wall", [&](toml::table& wall) { line(ground, points(wall), false); });
  return s;
}

void scatter_boxes(b2World& world, const Scenario& scenario, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0F;
  };
  const b2Vec2 low = b2Min(scenario.start, scenario.goal), high = b2Max(scenario.start, scenario.goal);
  for (int made = 0, tries = 0; made < count && tries < 1000 * count; ++tries) {
    const b2Vec2 at(uniform(low.x - 0.5F, high.x + 0.5F), uniform(low.y - 0.5F, high.y + 0.5F));
    if ((at - scenario.start).Length() < 0.5F || (at - scenario.goal).Length() < 0.5F) continue;
    b2BodyDef def;
    def.position = at;
    b2Body& none = *world.CreateBody(&def);
    const bool free = nearest_in_cone(world, none, at, 0, b2_pi / 2) > 0.35F &&
                      nearest_in_cone(world, none, at, b2_pi, b2_pi / 2) > 0.35F;
    world.DestroyBody(&none);
    if (!free) continue;
    def.type = b2_dynamicBody;
    def.angle = uniform(0, b2_pi);
    def.linearDamping = def.angularDamping = 8;  // friction on the floor
    b2PolygonShape box;
    box.m_radius = 0;
    const float side = uniform(0.1F, 0.2F);
    box.SetAsBox(side / 2, side / 2);
    world.CreateBody(&def)->CreateFixture(&box, uniform(0.2F, 0.8F) / (side * side));
    ++made;
  }
}

float nearest_in_cone(const b2World& world, const b2Body& without, b2Vec2 apex, float axis, float half) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body == &without) continue;
    const auto seen = [&](b2Vec2 p) { return body->GetWorldPoint(p) - apex; };
    for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
      const b2Shape* shape = f->GetShape();
      if (const auto* disc = dynamic_cast<const b2CircleShape*>(shape)) {
        nearest = b2Min(nearest, nearest_of_disc(seen(disc->m_p), disc->m_radius, axis, half));
      } else if (const auto* edge = dynamic_cast<const b2EdgeShape*>(shape)) {
        nearest =
            b2Min(nearest, nearest_of_segment(seen(edge->m_vertex1), seen(edge->m_vertex2), axis, half));
      } else if (const auto* solid = dynamic_cast<const b2PolygonShape*>(shape)) {
        for (int i = 0; i < solid->m_count; ++i) {
          const b2Vec2 a = solid->m_vertices[i], b = solid->m_vertices[(i + 1) % solid->m_count];
          nearest = b2Min(nearest, nearest_of_segment(seen(a), seen(b), axis, half));
        }
      }
    }
  }
  return nearest;
}
