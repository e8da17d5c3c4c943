#include "/work/wt/input/tests/grid/grid.cc"
#include "/work/wt/input/tests/grid/main.cc"
#include "/work/wt/input/tests/grid/walls.cc"
