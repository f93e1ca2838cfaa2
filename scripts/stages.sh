# shellcheck shell=bash
# The stages of scripts/test: each is a function that runs under set -e with its output in a log.

# Minimum coverage of firmware/ in per cent; raise it when the tests improve.
readonly line_floor=98
readonly branch_floor=92

readonly fuzz_seconds=${FUZZ_SECONDS:-60}
readonly soak_count=${SOAK_COUNT:-50}

jobs=$(nproc)
export CXX=g++  # of the presets that name no compiler
export CTEST_PARALLEL_LEVEL=$jobs
export UBSAN_OPTIONS=print_stacktrace=1
# Properties draw the same cases in every run of the gates; the stage long draws new ones.
export RC_PARAMS=${RC_PARAMS:-seed=1}

cxx_files() { find firmware hal host tests \( -name '*.hpp' -o -name '*.cpp' \) -print0; }

# The same file is compiled for several programs: the cache shares the objects, in one run and between runs.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=${CCACHE_DIR:-$PWD/build/ccache} CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
  export CCACHE_SLOPPINESS=pch_defines,time_macros
fi

# one_at_a_time PRESET COMMAND...: stages that run beside each other may share a build folder.
one_at_a_time() {
  mkdir -p build
  flock "build/$1.lock" "${@:2}"
}

configure() { one_at_a_time "$1" cmake --preset "$1"; }

# build PRESET [OPTION...]
build() {
  configure "$1"
  one_at_a_time "$1" cmake --build --preset "$1" -j "$jobs" "${@:2}" -- --quiet
}

# The gates on the source tree have the label build. They do not depend on the compiler, so one stage runs them.
build_and_test() {
  build "$1"
  ctest --preset "$1" --no-tests=error -LE '^(build|night|targets|vcan|vm)$'
}

stage_shell() {
  local scripts
  mapfile -t scripts < <(grep -slE '^(#!.*bash|# shellcheck shell=(ba)?sh)$' scripts/* scripts/vm/* .ci/run)
  ((${#scripts[@]}))
  for script in "${scripts[@]}"; do bash -n "$script"; done
  shellcheck -x "${scripts[@]}"
}

stage_format() { cxx_files | xargs -0 clang-format-14 --dry-run -Werror; }

stage_gcc() {
  build host
  ctest --preset host --no-tests=error -LE '^(cross|night|targets|vcan|vm)$'
}

stage_web() {
  build host --target whisker whisker_rig
  npm --prefix host/lab/web ci --ignore-scripts --no-audit --no-fund
  npm --prefix host/lab/web run check
  one_at_a_time pico scripts/playground --build-only
  node --test --test-reporter=tap tests/web/*.test.mjs
}

stage_cross() {
  configure host | tee build/cross-configure.log
  if grep "^-- No compiler for" build/cross-configure.log; then return 1; fi
  ctest --preset host --no-tests=error -L '^cross$' -LE '^night$' -V
}

# vcan_tests LABELS [OPTION...]: one with-vcan for all tests, because a micro-VM starts slowly. Each test gets a new vcan0,
# and creates and removes its other interfaces. ctest reads one folder only: an emulated processor needs seconds to list all.
vcan_tests() {
  local -r labels=$1 list=build/host/tests/vcan
  shift
  local names
  mapfile -t names < <(ctest --test-dir "$list" -N -L "$labels" | sed -n 's/^ *Test *#[0-9]*: //p')
  ((${#names[@]}))
  # shellcheck disable=SC2016  # for the other shell
  scripts/with-vcan --timeout $((600 * ${#names[@]})) "$@" bash -ec 'list=$1; shift
    for name; do
      ip link del vcan0
      ip link add dev vcan0 type vcan
      ip link set vcan0 up
      ctest --test-dir "$list" --output-on-failure --no-tests=error -j 1 -R "^$name\$"
    done' bash "$list" "${names[@]}"
}

# Uses a bus of this kernel if possible. Tests with the label vm need a complete machine, the micro-VM.
stage_vcan() {
  build host
  if [[ $(scripts/with-vcan --which 2>&1) == "with-vcan: vm" ]]; then
    vcan_tests '^(vcan|vm)$' --vm
  else
    vcan_tests '^vcan$'
    vcan_tests '^vm$' --vm
  fi
}

stage_targets() {
  scripts/chip --build --sample
  # Sequentially: each uses all processors.
  ctest --preset host --no-tests=error -L '^targets$' -LE '^night$' -V -j 1
}

# pico_tests FILE...: the image of the Pico in its emulator, rp2040js from the npm registry or from npm's cache.
pico_tests() {
  # The stage web, beside this one, runs with what is there.
  npm --prefix host/harness/pico ls >/dev/null ||
    one_at_a_time pico npm --prefix host/harness/pico ci --ignore-scripts --no-audit --no-fund
  build host --target whisker_rig whisker
  build pico
  node --test --test-reporter=tap "$@"
}

stage_pico() { pico_tests tests/pico/*.test.mjs; }

stage_clang() { build_and_test clang; }

# build_and_test_core PRESET LABELS TARGET...: builds only these programs, and runs the tests with these labels.
build_and_test_core() {
  local preset=$1 labels=$2
  shift 2
  build "$preset" --target "$@"
  find "build/$preset" -name '*.gcda' -delete
  ctest --preset "$preset" --no-tests=error -L "$labels"
}

# The code that chips run, and the simulator that tests it. The tests of perception drive missions, too.
stage_asan() {
  RC_PARAMS="$RC_PARAMS max_success=30" build_and_test_core asan '^(robot|fuzzy|perception|planning|global|bus|can|golden|slcan|sim)$' \
    whisker_core_tests whisker_core_properties whisker_fuzzy_tests whisker_perception_tests whisker_planning_tests whisker_global_tests \
    whisker_bus_tests whisker_can_tests whisker_golden_tests whisker_slcan_tests whisker_sim_tests
}

stage_asan_all() { build_and_test asan; }

stage_coverage() {
  RC_PARAMS="$RC_PARAMS max_success=500" build_and_test_core coverage '^(robot|fuzzy|perception|global|missions)$' \
    whisker_core_tests whisker_core_properties whisker_fuzzy_tests whisker_perception_tests whisker_global_tests whisker_run_tests
  # No exception can leave the core, so branches of a throw are excluded.
  gcovr -j "$jobs" --root . --filter firmware/ --exclude firmware/apps/ --exclude-throw-branches --json build/coverage/all.json \
    build/coverage
  {
    gcovr --root . --add-tracefile build/coverage/all.json
    gcovr --root . --add-tracefile build/coverage/all.json --branches
  } | tee build/coverage/summary.txt
  gcovr --root . --add-tracefile build/coverage/all.json --fail-under-line "$line_floor" \
    --fail-under-branch "$branch_floor" >/dev/null
}

# Their tests are those of the preset host.
stage_core() {
  build core
  build core-tests
}

# tidy [OPTION...]: clang-tidy on the core.
tidy() {
  configure core
  find firmware -path firmware/apps -prune -o -name "*.cpp" -print0 |
    xargs -0 -n 4 -P "$jobs" clang-tidy-14 -p build/core --quiet "$@"
}

# The static analyzer follows paths within functions only: across them, it takes eight times as long.
stage_tidy() {
  local option shallow=()
  for option in -Xclang -analyzer-config -Xclang mode=shallow; do shallow+=("--extra-arg=$option"); done
  tidy "${shallow[@]}"
}

stage_analyzer() { tidy '--checks=-*,clang-analyzer-*,-clang-analyzer-optin.performance.Padding'; }

stage_campaign() {
  build host
  scripts/measure bars --gate --count 25 --noisy 25
}

stage_long() {
  build_and_test core-tests
  build host
  scripts/measure bars --gate --count 50 --noisy 50
  export WHISKER_LONG=1
  RC_PARAMS="seed=$((RANDOM << 15 | RANDOM)) max_success=2000" ctest --preset host --no-tests=error -LE '^(targets|vcan|vm)$'
  scripts/chip --build
  ctest --preset host --no-tests=error -L '^targets$' -V -j 1
  one_at_a_time pico scripts/playground --build-only
  node --test --test-reporter=tap tests/web/core.test.mjs
  pico_tests tests/pico/*.test.mjs
}

stage_fuzz() {
  local fuzzer name text
  local mission='name = "bad"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 1\n'
  local event='[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 1\ny_m = 0\n[[event]]\n'
  build fuzz
  mkdir -p build/fuzz/bad
  while IFS='|' read -r name _ text; do
    text=${text/ @mission /$mission}
    printf %b "${text/ @event /$event}" >"build/fuzz/bad/${name% }"
  done < <(grep -v '^#' tests/scenario/bad.txt)
  for fuzzer in build/fuzz/fuzzers/*; do
    name=$(basename "$fuzzer")
    mkdir -p "build/fuzz/corpus/$name" "build/fuzz/findings"
    "$fuzzer" -max_total_time="$fuzz_seconds" -timeout=10 -artifact_prefix="build/fuzz/findings/$name-" \
      "build/fuzz/corpus/$name" host/worlds/scenarios tests/scenario/good build/fuzz/bad host/rules/examples
  done
}

stage_soak() {
  local seed=${SOAK_SEED:-$RANDOM}
  build asan
  echo "again: SOAK_SEED=$seed SOAK_COUNT=$soak_count scripts/test --only soak"
  WHISKER=build/asan/whisker scripts/measure outcomes "$soak_count" "$seed" skirt
}

# Only this stage needs the 118 packages, and fails where they cannot be installed.
stage_published() {
  build host --target whisker_rules_compare
  python3 -B tests/rules/published_test.py build/host/tests/rules/whisker_rules_compare
}

stage_octave() {
  scripts/setup octave
  build host --target whisker
  python3 -B tests/rules/octave_test.py build/host/whisker
}
