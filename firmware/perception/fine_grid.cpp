#include "firmware/perception/fine_grid.hpp"

namespace whisker::perception {

/// Of the fine cells whose centres lie in the span.
FineRow FineGrid::columns(const Span& span) noexcept {
  FineRow row{};
  for (int i = 0; i < kParts; ++i) {
    // Fine column 2k + i has its centre at 512 k + 256 i + 128, cell k at 256 k + 128.
    const int32_t shifted = kHalfCell - i * kUnitsPerCell;
    row.parts[i] = Span{-floor_div<int32_t>(-(span.low + shifted), kParts),
                        floor_div<int32_t>(span.high + shifted, kParts)}
                       .columns();
  }
  return row;
}

Row FineGrid::unclear(int row, const Span& touched) const noexcept {
  const FineRow columns = FineGrid::columns(touched);
  const FineRow& clear = clear_[slot(row)];
  return (columns.parts[0] & ~to_window(clear.parts[0])) | (columns.parts[1] & ~to_window(clear.parts[1]));
}

bool FineGrid::is_clear(GridPoint at) const noexcept {
  const int32_t row = at.y / kUnitsPerCell;
  return unclear(static_cast<int>(row),
                 {at.x - at.x % kUnitsPerCell, at.x - at.x % kUnitsPerCell + kUnitsPerCell}) == 0;
}

void FineGrid::mark(int row, const Span& clear) noexcept {
  const FineRow columns = FineGrid::columns(clear);
  for (int i = 0; i < kParts; ++i) clear_[slot(row)].parts[i] |= to_torus(columns.parts[i]);
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
    const FineRow near = columns(span);
    for (int i = 0; i < kParts; ++i) clear_[slot(row)].parts[i] &= to_torus(near.parts[i]);
  }
}

void FineGrid::forget(int row, Row cells) noexcept {
  for (int i = row * kParts; i < (row + 1) * kParts; ++i) {
    for (Row& parts : clear_[slot(i)].parts) parts &= ~cells;
  }
}

}  // namespace whisker::perception
