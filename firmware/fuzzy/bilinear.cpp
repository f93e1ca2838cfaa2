#include "firmware/fuzzy/bilinear.hpp"

namespace whisker::fuzzy {

template class BilinearGrid<5, 5>;

}  // namespace whisker::fuzzy
