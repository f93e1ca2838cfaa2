#pragma once

#include <memory>
#include <optional>

#include "firmware/can/rules_server.hpp"
#include "host/harness/run/planners.hpp"

namespace whisker::hil {

/// The response tables of a controller on this computer.
class HostRules {
 public:
  /// The table of the kind is the built-in one. storage: keeps a base's choice; null: it is lost at the end.
  explicit HostRules(PlannerKind kind, hal::Storage* storage = nullptr);

  /// Null: the planner has no table.
  can::RulesServer* server() { return server_.get(); }
  /// The kind with the active table.
  PlannerKind kind() const;
  /// What the storage had at the start; nothing, if there is none.
  fuzzy::Stored loaded() const { return loaded_; }

 private:
  const PlannerKind kind_;
  std::optional<fuzzy::TableStore> store_;
  std::unique_ptr<can::RulesServerWith<2>> server_;
  fuzzy::Stored loaded_ = fuzzy::Stored::nothing;
};

/// The table of this kind as a base sends it; null: the planner has none.
const can::RulesServer::Table* table_to_send(PlannerKind kind);

}  // namespace whisker::hil
