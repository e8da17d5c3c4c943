# Tests that run the program itself. A driver prints one line per check and exits with 1 when one fails.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
# Some look into HDF5 files. A Python of the user's own may stand before the one that has the packages.
execute_process(COMMAND ${Python3_EXECUTABLE} -c "import h5py, numpy" RESULT_VARIABLE lacks_packages OUTPUT_QUIET ERROR_QUIET)
if(lacks_packages AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()

# Runs on one rank are copies of one program (copies.py).
add_library(fork_server MODULE ${CMAKE_CURRENT_SOURCE_DIR}/fork_server.cc)
target_link_libraries(fork_server PRIVATE ${CMAKE_DL_LIBS})
set(TALUS_RUN_ENVIRONMENT "${TALUS_TEST_ENVIRONMENT}" "TALUS_FORK_SERVER_LIBRARY=$<TARGET_FILE:fork_server>")

# talus_add_run(NAME RANKS COMMAND...): a test that keeps `ranks` cores busy.
function(talus_add_run name ranks)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${ARGN})
  set_tests_properties(${name} PROPERTIES PROCESSORS ${ranks} TIMEOUT 300
    ENVIRONMENT "${TALUS_RUN_ENVIRONMENT}")
endfunction()

set(work ${CMAKE_CURRENT_BINARY_DIR}/runs)
set(shear ${PROJECT_SOURCE_DIR}/prm/shear.prm)

# Exit status and message of wrong inputs.
foreach(group command_line element entries numbers functions bodies points surroundings meshes diverged
    run kernel grid materials more_bodies conditions results files directories checkpoints)
  # How several ranks end is the same for what is read alike.
  set(n_ranks 1)
  if(NOT group MATCHES "run|kernel|grid|materials|more_bodies|conditions|results|element|entries|numbers|functions")
    set(n_ranks 1 2)
  endif()
  foreach(ranks ${n_ranks})
    talus_add_run(errors.${group}.mpirun=${ranks} ${ranks}
      ${CMAKE_CURRENT_SOURCE_DIR}/errors/run.py $<TARGET_FILE:talus> ${shear}
      ${work}/errors/${group}.${ranks} ${group} ${ranks} ${MPIRUN})
  endforeach()
endforeach()

# Spoiled files: 300 of them, and many.
function(talus_fuzz name n seed timeout)
  talus_add_run(${name} 1 ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/run.py $<TARGET_FILE:talus> ${work}/${name} ${n} ${seed})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${timeout})
endfunction()
talus_fuzz(fuzz 300 1 600)
talus_fuzz(fuzz.many 10000 2 7200)
set_tests_properties(fuzz.many PROPERTIES LABELS long)

foreach(ranks 1 2)
  talus_add_run(install.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/install.py ${CMAKE_COMMAND}
    ${PROJECT_BINARY_DIR} ${work}/install.${ranks} ${ranks} ${MPIRUN})
endforeach()

talus_add_run(contrib.plot 1 ${CMAKE_CURRENT_SOURCE_DIR}/plot.py $<TARGET_FILE:talus> ${PROJECT_SOURCE_DIR} ${work}/plot)

talus_add_run(help 1 ${CMAKE_CURRENT_SOURCE_DIR}/help.py $<TARGET_FILE:talus> ${PROJECT_SOURCE_DIR})

# What the pages print can be typed.
foreach(page README doc/tour doc/gallery doc/element doc/stages)
  string(REPLACE / . name ${page})
  talus_add_run(commands.${name} 2 ${CMAKE_CURRENT_SOURCE_DIR}/commands.py ${page}.md ${PROJECT_BINARY_DIR}
    ${work}/commands.${name} ${MPIRUN})
endforeach()
set_tests_properties(commands.doc.tour commands.doc.gallery commands.doc.stages PROPERTIES LABELS long)

# Help of the commands, which needs no build and makes none.
foreach(command fingerprint gallery install-dependencies manual plot quickstart report reproduce test throughput)
  add_test(NAME contrib.help.${command} COMMAND ${PROJECT_SOURCE_DIR}/contrib/${command} --help)
  set_tests_properties(contrib.help.${command} PROPERTIES TIMEOUT 60 ENVIRONMENT "TALUS_BUILD=${work}/no build"
    PASS_REGULAR_EXPRESSION "contrib/${command}|Installs" FAIL_REGULAR_EXPRESSION "cmake|ninja")
endforeach()

# talus_compare(FILE NAME "VARIANT..." "Section/Entry = value"...): the same statistics in all variants.
string(REPLACE ";" " " mpirun "${MPIRUN}")
function(talus_compare file name variants)
  set(settings)
  foreach(setting ${ARGN})
    list(APPEND settings --set ${setting})
  endforeach()
  talus_add_run(compare.${file}.${name} 2
    ${CMAKE_CURRENT_SOURCE_DIR}/compare/compare.py $<TARGET_FILE:talus>
    ${CMAKE_CURRENT_SOURCE_DIR}/compare/${file}.prm ${work}/compare/${file}.${name} ${mpirun} ${variants} ${settings})
endfunction()

set(ranks 1 2 4)
talus_compare(balls_2d quadratic_TPIC "${ranks}" "Kernel/Type = quadratic B-spline" "Transfer/Type = TPIC")
# With cubic kernels particles may stray a whole cell. Here none does so between two ranks; that is for the disk.
talus_compare(balls_2d cubic_APIC "1;4" "Kernel/Type = cubic B-spline" "Transfer/Type = APIC")
talus_compare(disk_2d cubic_APIC "${ranks}" "Kernel/Type = cubic B-spline" "Transfer/Type = APIC")
talus_compare(balls_2d uGIMP_blend "${ranks}"
  "Kernel/Type = uGIMP" "Kernel/Boundary treatment = WLS separable" "Transfer/Type = blend")
talus_compare(disk_2d quadratic_FLIP "${ranks}" "Kernel/Type = quadratic B-spline" "Transfer/Type = FLIP")
talus_compare(block_2d linear_FLIP "${ranks}")
talus_compare(balls_3d quadratic_TPIC "${ranks}" "Kernel/Type = quadratic B-spline" "Transfer/Type = TPIC")
talus_compare(balls_3d cubic_APIC "${ranks}"
  "Kernel/Type = cubic B-spline" "Transfer/Type = APIC" "Run/End time = 0.4")
talus_compare(balls_3d uGIMP_FLIP "${ranks}" "Kernel/Type = uGIMP" "Transfer/Type = FLIP")
# Domains that follow their particles reach across the ranks' borders, and over several cells where they are stretched.
talus_compare(balls_2d CPDI_FLIP "${ranks}" "Kernel/Type = CPDI" "Transfer/Type = FLIP")
talus_compare(disk_2d CPDI_APIC "${ranks}" "Kernel/Type = CPDI" "Transfer/Type = APIC")
talus_compare(balls_2d CPLS "${ranks}" "Kernel/Type = CPDI" "Transfer/Type = CPLS")
talus_compare(balls_3d CPDI_TPIC "${ranks}" "Kernel/Type = CPDI" "Kernel/Layers = 1" "Transfer/Type = TPIC")
talus_compare(balls_3d CPLS "1;2" "Kernel/Type = CPDI" "Kernel/Layers = 1" "Transfer/Type = CPLS" "Run/End time = 0.4")
talus_compare(stretch_2d CPDI_TPIC "${ranks}" "Kernel/Type = CPDI" "Transfer/Type = TPIC")
talus_compare(stretch_2d CPLS "${ranks}" "Kernel/Type = CPDI" "Transfer/Type = CPLS")
talus_compare(balls_2d MUSL "${ranks}" "Run/MUSL = true" "Run/Mass cutoff = 1e-4" "Transfer/Type = FLIP")
talus_compare(balls_3d MUSL "${ranks}" "Run/MUSL = true")
foreach(pool pool_2d pool_3d)
  talus_compare(${pool} projection_TPIC "${ranks}"
    "Kernel/Boundary treatment = WLS separable" "Transfer/Slip projection = true")
  talus_compare(${pool} mirror_APIC "${ranks}" "Kernel/Boundary treatment = mirror" "Transfer/Type = APIC")
endforeach()
talus_compare(walls_2d ghost_APIC "${ranks}" "Transfer/Type = APIC")
talus_compare(walls_2d ghost_cubic_FLIP "${ranks}" "Kernel/Type = cubic B-spline" "Transfer/Type = FLIP")
talus_compare(walls_2d ghost_uGIMP_blend "1;4" "Kernel/Type = uGIMP" "Transfer/Type = blend" "Run/Courant number = 0.2")
talus_compare(walls_2d ghost_MUSL "1;2" "Run/MUSL = true")
talus_compare(walls_3d ghost_TPIC "${ranks}" "Transfer/Type = TPIC")
talus_compare(bed_2d TPIC "${ranks}")
talus_compare(bed_2d MUSL "1;2" "Run/MUSL = true" "Transfer/Type = FLIP" "Kernel/Boundary treatment = none")
talus_compare(pool_3d ghost_TPIC "${ranks}" "Kernel/Boundary treatment = ghost nodes")
# Writing output must not change the run.
talus_compare(disk_2d output "1;2, Output/Step interval = 7, Output/CSV = true, Output/Grid = true"
  "Transfer/Type = APIC")

# On meshes of simplices; the balls slide along named walls.
set(mesh "Grid/Type = mesh")
talus_compare(disk_2d UMLS_APIC "${ranks}" ${mesh} "Kernel/Type = UMLS" "Transfer/Type = APIC")
talus_compare(disk_2d C1_UMLS_FLIP "${ranks}" ${mesh} "Kernel/Type = C1 UMLS" "Transfer/Type = FLIP")
# Gradients of P1 jump at faces, where round-off decides: after 1100 small steps it has grown to the bound, after half of them not.
talus_compare(disk_2d P1_PIC "1;4" ${mesh} "Kernel/Type = P1" "Transfer/Type = PIC" "Run/Courant number = 0.1" "Run/End time = 0.1")
set(walls "Conditions/walls/Boundary ids = "
  "Conditions/walls/Boundaries = lower x, upper x, lower y, upper y, lower z, upper z")
talus_compare(balls_3d UMLS_TPIC "${ranks}" ${mesh} ${walls} "Kernel/Type = UMLS" "Transfer/Type = TPIC")
talus_compare(balls_3d C1_UMLS_APIC "1;4" ${mesh} ${walls} "Kernel/Type = C1 UMLS" "Transfer/Type = APIC")
# Velocities scattered once more, and walls at which the mesh goes on as its mirror image.
talus_compare(disk_2d UMLS_MUSL "${ranks}" ${mesh} "Kernel/Type = UMLS" "Run/MUSL = true" "Run/Mass cutoff = 1e-4"
  "Run/End time = 0.1")
talus_compare(balls_3d UMLS_mirrors "1;2" ${mesh} ${walls} "Kernel/Type = UMLS" "Transfer/Type = APIC" "Run/MUSL = true"
  "Grid/Slip mirrors = lower x, upper x, lower y, upper y, lower z, upper z")

foreach(file flight_2d rotation_2d flight_3d rotation_3d
    flight_mesh_2d rotation_mesh_2d flight_mesh_3d rotation_mesh_3d)
  talus_add_run(conservation.${file} 1 ${CMAKE_CURRENT_SOURCE_DIR}/conservation/run.py $<TARGET_FILE:talus>
    ${CMAKE_CURRENT_SOURCE_DIR}/conservation/${file}.prm ${work}/conservation/${file} 1)
endforeach()

# The other kernels of meshes, and velocities scattered once more. P1 does not outlast these.
function(talus_mesh_conservation file name)
  talus_add_run(conservation.${file}.${name} 1 ${CMAKE_CURRENT_SOURCE_DIR}/conservation/run.py $<TARGET_FILE:talus>
    ${CMAKE_CURRENT_SOURCE_DIR}/conservation/${file}.prm ${work}/conservation/${file}.${name} 1 -- ${ARGN})
endfunction()
talus_mesh_conservation(flight_mesh_2d C1_UMLS "Kernel/Type = C1 UMLS")
talus_mesh_conservation(rotation_mesh_2d MUSL "Run/MUSL = true")

foreach(ranks 1 2)
  talus_add_run(regression.shear.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/regression/shear.py
    $<TARGET_FILE:talus> ${shear} ${work}/regression/shear.${ranks} ${ranks} ${MPIRUN})
  talus_add_run(regression.load_curve.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/regression/load_curve.py
    $<TARGET_FILE:talus> ${CMAKE_CURRENT_SOURCE_DIR}/regression/load_curve.prm ${work}/regression/load_curve.${ranks}
    ${ranks} ${MPIRUN})
  talus_add_run(regression.reference_motion.mpirun=${ranks} ${ranks}
    ${CMAKE_CURRENT_SOURCE_DIR}/regression/reference_motion.py $<TARGET_FILE:talus>
    ${CMAKE_CURRENT_SOURCE_DIR}/regression/reference_motion.prm ${work}/regression/reference_motion.${ranks} ${ranks}
    ${MPIRUN})
  talus_add_run(regression.viscous.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/regression/viscous.py
    $<TARGET_FILE:talus> ${PROJECT_SOURCE_DIR}/prm/dam_break.prm ${work}/regression/viscous.${ranks} ${ranks} ${MPIRUN})
endforeach()

# The benchmarks of prm/ on coarse grids.
foreach(case disk_TPIC disk_APIC footing still_water dam martin_moyce column_TPIC column_APIC column_cohesion
    column_friction taylor)
  foreach(ranks 1 2)
    talus_add_run(regression.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/regression/benchmarks.py
      $<TARGET_FILE:talus> ${work}/regression/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()

# Manufactured solutions: orders.
foreach(case vibration ring)
  foreach(ranks 1 2)
    talus_add_run(regression.${case}.mpirun=${ranks} ${ranks}
      ${CMAKE_CURRENT_SOURCE_DIR}/regression/verification.py
      $<TARGET_FILE:talus> ${work}/regression/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()

# Friction, damping and loads against closed forms.
foreach(case incline_2d incline_3d bed_2d bed_3d shelf account damping energy bar_2d bar_3d pressure_2d pressure_3d wave_2d wave_3d layer)
  foreach(ranks 1 2)
    talus_add_run(loads.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/loads/run.py
      $<TARGET_FILE:talus> ${work}/loads/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()

# Single points of materials against closed forms; all ranks compute the same.
foreach(case triaxial plane_strain shear apex run elastic finite plastic wide fluid stages)
  talus_add_run(element.${case}.mpirun=1 1 ${CMAKE_CURRENT_SOURCE_DIR}/element/run.py $<TARGET_FILE:talus>
    ${work}/element/${case}.1 ${case} 1 ${MPIRUN})
endforeach()
foreach(case run stages)
  talus_add_run(element.${case}.mpirun=2 2 ${CMAKE_CURRENT_SOURCE_DIR}/element/run.py $<TARGET_FILE:talus>
    ${work}/element/${case}.2 ${case} 2 ${MPIRUN})
endforeach()

# Runs that are stopped and resumed.
talus_add_run(checkpoint.coverage 1 ${CMAKE_CURRENT_SOURCE_DIR}/checkpoint/run.py
  $<TARGET_FILE:talus> ${work}/checkpoint/coverage coverage 1)
foreach(case boxes others undisturbed signals killed directory h5py)
  foreach(ranks 1 2)
    talus_add_run(checkpoint.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/checkpoint/run.py
      $<TARGET_FILE:talus> ${work}/checkpoint/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()
talus_add_run(checkpoint.ranks 2 ${CMAKE_CURRENT_SOURCE_DIR}/checkpoint/run.py
  $<TARGET_FILE:talus> ${work}/checkpoint/ranks ranks 1 ${MPIRUN})
foreach(ranks 2 4)
  talus_add_run(checkpoint.balance.mpirun=${ranks} 2 ${CMAKE_CURRENT_SOURCE_DIR}/checkpoint/run.py
    $<TARGET_FILE:talus> ${work}/checkpoint/balance.${ranks} balance ${ranks} ${MPIRUN})
endforeach()
# When what is written, and what a run says of itself beforehand.
foreach(ranks 1 2)
  foreach(case times expected summary sweep hdf5)
    talus_add_run(outputs.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/inputs/outputs.py
      $<TARGET_FILE:talus> ${work}/outputs/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()
talus_add_run(outputs.topics 1 ${CMAKE_CURRENT_SOURCE_DIR}/inputs/outputs.py
  $<TARGET_FILE:talus> ${work}/outputs/topics topics 1 ${MPIRUN})

# Parts of a run with parameters of their own.
foreach(ranks 1 2)
  foreach(case column nothing resets resumed safety wrong)
    talus_add_run(stages.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/stages/run.py
      $<TARGET_FILE:talus> ${work}/stages/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()
talus_add_run(checkpoint.killed_often 2 ${CMAKE_CURRENT_SOURCE_DIR}/checkpoint/run.py
  $<TARGET_FILE:talus> ${work}/checkpoint/killed_often killed_often 2 ${MPIRUN})
set_tests_properties(checkpoint.killed_often PROPERTIES LABELS long TIMEOUT 1800)

# What particles remember, and what files say of them.
foreach(case path silo_2d silo_3d drop initial_stress far mirror_reaction water)
  foreach(ranks 1 2)
    talus_add_run(states.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/states/run.py
      $<TARGET_FILE:talus> ${work}/states/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()

# Inputs as people write them: right, or refused with the cause.
foreach(case grid_lines point_files box_edge overlap moving_wall formulas no_floor surface_level checks switched_off messages
    fracture unrolled_slide)
  foreach(ranks 1 2)
    talus_add_run(inputs.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/inputs/run.py
      $<TARGET_FILE:talus> ${work}/inputs/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()
foreach(case headers tables where commas sizes mesh_files clipping idle energy_watch)
  foreach(ranks 1 2)
    talus_add_run(inputs.${case}.mpirun=${ranks} ${ranks} ${CMAKE_CURRENT_SOURCE_DIR}/inputs/checks.py
      $<TARGET_FILE:talus> ${work}/inputs/${case}.${ranks} ${case} ${ranks} ${MPIRUN})
  endforeach()
endforeach()
