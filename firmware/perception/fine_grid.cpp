#include "firmware/perception/fine_grid.hpp"

namespace whisker::perception {
namespace {

/// Bit i if bit 2i or 2i + 1 is set.
uint32_t halved(uint32_t parts) noexcept {
  uint32_t x = (parts | parts >> 1) & 0x55555555U;
  x = (x | x >> 1) & 0x33333333U;
  x = (x | x >> 2) & 0x0F0F0F0FU;
  x = (x | x >> 4) & 0x00FF00FFU;
  return (x | x >> 8) & 0x0000FFFFU;
}

/// Bits 2i and 2i + 1 if bit i < 16 is set.
uint32_t doubled(uint32_t cells) noexcept {
  uint32_t x = cells & 0x0000FFFFU;
  x = (x | x << 8) & 0x00FF00FFU;
  x = (x | x << 4) & 0x0F0F0F0FU;
  x = (x | x << 2) & 0x33333333U;
  x = (x | x << 1) & 0x55555555U;
  return x | x << 1;
}

constexpr int32_t kHalfOfWindow = kCells * kUnitsPerCell;

FineRow joined(Row low, Row high) noexcept { return low | static_cast<FineRow>(high) << kCells; }

}  // namespace

FineRow FineGrid::columns(const Span& span) noexcept {
  return joined(span.columns(), Span{span.low - kHalfOfWindow, span.high - kHalfOfWindow}.columns());
}

Row FineGrid::cells_of(FineRow parts) noexcept {
  return halved(static_cast<uint32_t>(parts)) | halved(static_cast<uint32_t>(parts >> kCells))
                                                    << (kCells / 2);
}

void FineGrid::reset() noexcept {
  for (FineRow& row : clear_) row = 0;
}

void FineGrid::move_to(int32_t column, int32_t row) noexcept {
  const int32_t right = column * kParts - frame_.column;
  const int32_t up = row * kParts - frame_.row;
  frame_.column += right;
  frame_.row += up;
  if (right >= kFineCells || right <= -kFineCells || up >= kFineCells || up <= -kFineCells) {
    reset();
    return;
  }
  if (right == 0 && up == 0) return;
  const FineRow all = ~FineRow{0};
  const FineRow keep = to_torus(right > 0 ? all >> right : all << -right);
  for (int i = 0; i < kFineCells; ++i) {
    FineRow& cells = clear_[slot(i)];
    cells &= up > 0 && i >= kFineCells - up ? 0 : up < 0 && i < -up ? 0 : keep;
  }
}

void FineGrid::mark_around(GridPoint centre, int32_t radius) noexcept {
  for (Rows rows(centre.y, centre.y, radius, kFineCells); rows.more(); rows.next()) {
    Span span = Span::around(centre.x, radius);
    span.inside_disc(centre.x, rows.offset(centre.y), radius);
    mark(rows.row(), span);
  }
}

void FineGrid::keep_around(GridPoint centre, int32_t radius) noexcept {
  for (int row = 0; row < kFineCells; ++row) {
    Span span = Span::around(centre.x, radius);
    span.within_disc(centre.x, row * kUnitsPerCell + kHalfCell - centre.y, radius);
    clear_[slot(row)] &= to_torus(columns(span));
  }
}

void FineGrid::forget(int row, Row cells) noexcept {
  if (cells == 0) return;
  const FineRow parts = to_torus(joined(doubled(cells), doubled(cells >> (kCells / 2))));
  for (int i = 0; i < kParts; ++i) clear_[slot(row * kParts + i)] &= ~parts;
}

}  // namespace whisker::perception
