#include "firmware/params.hpp"

int main() { return whisker::check(whisker::Params{}) == whisker::ParamFault::none ? 0 : 1; }
