# Front end of the CMake presets. Each target first installs the packages that it needs (scripts/setup).
# Without apt-get, install the packages listed by `scripts/setup --list GROUP` manually, and add `SETUP=true`
# to the make command.
SETUP ?= scripts/setup
JOBS ?= $(shell nproc)
# Some tests wait for brokers, cameras and clocks, so more tests than cores run in parallel.
TEST_JOBS ?= $(shell expr $(JOBS) + 2)
PREFIX ?= /usr/local
# Duration of each fuzz target, in seconds.
FUZZ_SECONDS ?= 60
# Cleared, because an inherited jobserver would limit Ninja to one core.
BUILD = env -u MAKEFLAGS cmake --build --preset
RELEASE = build/release

.DEFAULT_GOAL := release
.PHONY: release setup demo test quick asan fuzz bench parsers accuracy budget portable python wasm web api docs format lint check install clean

# The groups of scripts/setup that each target needs.
release: GROUPS = live
demo: GROUPS = core
test quick: GROUPS = tests
asan: GROUPS = tests
fuzz: GROUPS = fuzz
bench: GROUPS = bench
accuracy: GROUPS = tools
budget portable: GROUPS = firmware
wasm web: GROUPS = wasm tests
python: GROUPS = python
api: GROUPS = api
docs: GROUPS = docs
lint format: GROUPS = format
check: GROUPS = format tools
parsers: GROUPS = tests

release: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS)

setup:
	@$(SETUP) $(GROUPS)

# Runs CMake again if packages were installed since the last configuration, because more parts can then be
# built. `setup` is phony, so this rule runs every time.
build/%/build.ninja: setup
	@for cause in CMakePresets.json build/packages-installed; do \
	    if [ ! -f $@ ] || [ $$cause -nt $@ ]; then cmake --preset $* && touch $@ || exit 1; fi; \
	done

demo: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_demo
	$(RELEASE)/bin/dotpose_demo

test: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target all dotpose_tests
	ctest --preset release -j $(TEST_JOBS)

quick: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_quick_tests
	ctest --preset quick -j $(JOBS)

asan: build/asan/build.ninja
	$(BUILD) asan -j $(JOBS) --target all dotpose_tests
	ctest --preset asan -j $(JOBS)

# Tests of the layers that parse untrusted input: unit tests, and the replayed seeds of the fuzz targets,
# under the same sanitizers as in `asan`.
parsers: build/parsers/build.ninja
	$(BUILD) parsers -j $(JOBS) --target dotpose_parser_tests
	ctest --preset parsers -j $(JOBS)

# Also runs the unit tests of the fuzzed layers, under the same sanitizers.
fuzz: build/fuzz/build.ninja
	cmake --preset fuzz -DDOTPOSE_FUZZ_SECONDS=$(FUZZ_SECONDS)
	$(BUILD) fuzz -j $(JOBS) --target dotpose_fuzz dotpose_tests
	ctest --preset fuzz -j $(JOBS)

bench: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_bench dotpose_instructions
	$(RELEASE)/bin/dotpose_bench $(ARGS)
	bench/instructions $(if $(findstring --update,$(ARGS)),--update)

accuracy: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_tables
	$(RELEASE)/bin/dotpose_tables accuracy $(ARGS)

# With ARGS=--all: all frame sizes and processors.
ifneq ($(findstring --all,$(ARGS)),)
more_frames = dotpose_frames_160x120 dotpose_frames_320x240
more_cores = cortex-m4f cortex-m33 rv32imc
endif
# With ARGS=--quick: Cortex-M0+ only.
cores = cortex-m0plus $(if $(findstring --quick,$(ARGS)),,mips32r2)
budget: $(RELEASE)/build.ninja $(patsubst %,build/%/build.ninja,$(cores) $(more_cores))
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_frames dotpose_frames_36x36 dotpose_count \
	    dotpose_golden_files $(more_frames)
	set -e; for core in $(cores); do $(BUILD) $$core -j $(JOBS) --target all dotpose_firmware_36x36; done
	$(if $(more_cores),set -e; for core in cortex-m0plus mips32r2 $(more_cores); do \
	    $(BUILD) $$core -j $(JOBS) --target dotpose_firmware_of_all_sizes; done)
	firmware/budget $(ARGS)
	$(RELEASE)/bin/dotpose_golden_files build/budget/golden
	wrappers/c/device/run build/cortex-m0plus/wrappers/c/libdotpose_c.a build/budget/golden

portable: setup
	scripts/check-portable
	tests/checks/portable_selftest scripts

wasm: $(RELEASE)/build.ninja
	wrappers/wasm/build
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_golden_files
	ctest --preset release -L wasm

web: $(RELEASE)/build.ninja
	wrappers/wasm/build
	web/build
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_fleet_load
	ctest --preset release -L web

# Builds a wheel in build/python and an environment with it, and runs an example.
PYTHON = /usr/bin/python3
python: $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_python
	rm -rf build/python
	DOTPOSE_BUILD=$(CURDIR)/$(RELEASE) $(PYTHON) -m build --wheel --no-isolation \
	    -o build/python wrappers/python
	$(PYTHON) -m venv --system-site-packages build/python/venv
	build/python/venv/bin/pip install --no-index build/python/*.whl
	build/python/venv/bin/python wrappers/python/examples/first.py
	@echo 'Begin: . build/python/venv/bin/activate'

# API pages of the public headers in build/docs/cpp. Fails if there are warnings.
api: setup
	mkdir -p build
	DOTPOSE_VERSION=$$(sed -n 's/^#define DOTPOSE_VERSION "\(.*\)"/\1/p' include/dotpose/version.hpp) \
	    doxygen cmake/Doxyfile

# API pages of all languages, with the start page build/docs/index.html.
docs: $(RELEASE)/build.ninja api
	$(BUILD) release -j $(JOBS) --target dotpose_python
	PYTHONPATH=$(RELEASE)/wrappers/python $(PYTHON) -m sphinx -q -W -b html wrappers/python/docs build/docs/python
	cd wrappers/wasm && npm ci --no-audit --no-fund && npx typedoc
	cp docs/api.html build/docs/index.html

format: setup
	scripts/format

# Checks that need no build.
lint: setup
	scripts/format --check
	scripts/check-layers
	scripts/check-names
	scripts/check-design
	scripts/generate-fields --check
	scripts/check-recipes
	if command -v doxygen >/dev/null; then $(MAKE) api SETUP=true; fi

check: lint $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose dotpose_tables
	scripts/golden-frames
	scripts/check-core-symbols $(RELEASE)/src/libdotpose.a

# Does not run setup: `sudo make install` after `make` only copies files.
install:
	@test -f $(RELEASE)/src/libdotpose.a || { echo 'Nothing built yet: run make first.' >&2; exit 1; }
	cmake --install $(RELEASE) --prefix $(PREFIX)

clean:
	rm -rf build demo-out accuracy-out bench-out
