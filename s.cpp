#include "firmware/robot.hpp"
#include "firmware/nav/skirt.hpp"
#include "firmware/nav/thesis.hpp"
using namespace whisker; template<int N> struct S; S<sizeof(Robot)> a; S<sizeof(nav::TableSkirt)> b; S<sizeof(nav::ThesisPlanner)> c; S<sizeof(Params)> d; S<sizeof(ground::Patch)> e; S<sizeof(Status)> f;S<sizeof(ranges::Conditioner)> g;S<sizeof(motion::History)> h;S<sizeof(ground::Witness)> w;
