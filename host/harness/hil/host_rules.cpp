#include "host/harness/hil/host_rules.hpp"

namespace whisker::hil {

HostRules::HostRules(PlannerKind kind, hal::Storage* storage) : kind_(kind) {
  if (is_baseline(kind)) return;
  if (storage != nullptr) store_.emplace(*storage);
  server_ = std::make_unique<can::RulesServerWith<2>>(*kind.table, store_ ? &*store_ : nullptr);
  loaded_ = server_->load();
}

const can::RulesServer::Table* table_to_send(PlannerKind kind) {
  return is_baseline(kind) ? nullptr : kind.table;
}

PlannerKind HostRules::kind() const {
  PlannerKind kind = kind_;
  if (server_) kind.table = &server_->active();
  return kind;
}

}  // namespace whisker::hil
