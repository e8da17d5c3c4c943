// A unit square with a round hole, whose lower half has finer cells: the plate of tests/mesh. Written by
// gmsh -2 -format msh41 plate.geo
Point(1) = {0, 0, 0, .08};
Point(2) = {1, 0, 0, .08};
Point(3) = {1, 1, 0, .16};
Point(4) = {0, 1, 0, .16};
Point(5) = {.5, .5, 0};
Point(6) = {.7, .5, 0, .1};
Point(7) = {.3, .5, 0, .1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 6};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6};
Plane Surface(1) = {1, 2};
Physical Curve("bottom", 11) = {1};
Physical Curve("outer wall", 12) = {2, 3, 4};
Physical Curve(13) = {5, 6};
Physical Surface("plate", 1) = {1};
