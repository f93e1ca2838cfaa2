#include "host/hil/host_rules.hpp"

#include <type_traits>

namespace whisker::hil {
namespace {

using Server = can::RulesServerWith<2>;

/// By template, because only an engine with this table compiles it.
template <class Table>
std::unique_ptr<Server> make_server(const Table& built_in, fuzzy::TableStore* store) {
  if constexpr (std::is_same_v<Table, Server::Table>) {
    return std::make_unique<Server>(built_in, store);
  } else {
    return nullptr;
  }
}

template <class Table>
const Table* active(const Server& server) {
  if constexpr (std::is_same_v<Table, Server::Table>) {
    return &server.active();
  } else {
    return nullptr;
  }
}

template <class Table>
const Server::Table* sendable(const Table& table) {
  if constexpr (std::is_same_v<Table, Server::Table>) {
    return &table;
  } else {
    return nullptr;
  }
}

}  // namespace

HostRules::HostRules(PlannerKind kind, hal::Storage* storage) : kind_(kind) {
  if (is_baseline(kind)) return;
  if (storage != nullptr) store_.emplace(*storage);
  server_ = make_server(*kind.table, store_ ? &*store_ : nullptr);
  if (server_) loaded_ = server_->load();
}

const Server::Table* table_to_send(PlannerKind kind) {
  return is_baseline(kind) ? nullptr : sendable(*kind.table);
}

PlannerKind HostRules::kind() const {
  PlannerKind kind = kind_;
  if (server_) kind.table = active<fuzzy::Engine::Table>(*server_);
  return kind;
}

}  // namespace whisker::hil
