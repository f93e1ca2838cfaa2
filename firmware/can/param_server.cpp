#include "firmware/can/param_server.hpp"

namespace whisker::can {
namespace {

class Reader {
 public:
  explicit Reader(uint8_t index) noexcept : index_(index) {}
  template <class T>
  void number(const char*, const T& field, T, T) noexcept {
    take(static_cast<uint32_t>(field.raw()));
  }
  void count(const char*, const int32_t& field, int32_t, int32_t) noexcept {
    take(static_cast<uint32_t>(field));
  }
  template <class E>
  void choice(const char*, const E& field, const char* const*, int) noexcept {
    take(static_cast<uint32_t>(field));
  }
  bool found() const noexcept { return found_; }
  uint32_t raw() const noexcept { return raw_; }

 private:
  void take(uint32_t raw) noexcept {
    if (at_++ != index_) return;
    found_ = true;
    raw_ = raw;
  }
  const int index_;
  int at_ = 0;
  bool found_ = false;
  uint32_t raw_ = 0;
};

class Writer {
 public:
  Writer(uint8_t index, uint32_t raw) noexcept : index_(index), raw_(raw) {}
  template <class Tag>
  void number(const char*, Unit<Tag>& field, Unit<Tag> low, Unit<Tag> high) noexcept {
    const auto value = Unit<Tag>::from_raw(as_signed(raw_));
    if (mine() && fits(low <= value && value <= high)) field = value;
  }
  void number(const char*, Angle& field, Angle low, Angle high) noexcept {
    if (mine() && fits(low.raw() <= raw_ && raw_ <= high.raw())) field = Angle::from_raw(raw_);
  }
  void count(const char*, int32_t& field, int32_t low, int32_t high) noexcept {
    if (mine() && fits(low <= as_signed(raw_) && as_signed(raw_) <= high)) field = as_signed(raw_);
  }
  template <class E>
  void choice(const char*, E& field, const char* const*, int names) noexcept {
    if (mine() && fits(raw_ < static_cast<uint32_t>(names))) field = static_cast<E>(raw_);
  }
  ParamStatus status() const noexcept { return status_; }

 private:
  bool mine() noexcept { return at_++ == index_; }
  bool fits(bool does) noexcept {
    status_ = does ? ParamStatus::ok : ParamStatus::out_of_range;
    return does;
  }
  const int index_;
  const uint32_t raw_;
  int at_ = 0;
  ParamStatus status_ = ParamStatus::no_such;
};

}  // namespace

bool read_param(const Params& params, uint8_t index, uint32_t& raw) noexcept {
  Reader reader{index};
  for_each_param(params, reader);
  if (reader.found()) raw = reader.raw();
  return reader.found();
}

ParamStatus write_param(Params& params, uint8_t index, uint32_t raw) noexcept {
  Writer writer{index, raw};
  for_each_param(params, writer);
  return writer.status();
}

ParamReply ParamServer::answer(const ParamRequest& request, bool busy, bool& committed) noexcept {
  committed = false;
  ParamReply reply;
  reply.index = request.index;
  if (request.action != ParamAction::read && busy) {
    reply.status = ParamStatus::busy;
  } else if (request.action == ParamAction::commit) {
    const ParamFault fault = check(staged_);
    reply.value = static_cast<uint32_t>(fault);
    committed = fault == ParamFault::none;
    reply.status = committed ? ParamStatus::ok : ParamStatus::inconsistent;
    return reply;
  } else if (request.action == ParamAction::write) {
    reply.status = write_param(staged_, request.index, request.value);
  }
  if (!read_param(staged_, request.index, reply.value) && reply.status == ParamStatus::ok) {
    reply.status = ParamStatus::no_such;
  }
  return reply;
}

}  // namespace whisker::can
