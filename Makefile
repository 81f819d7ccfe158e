# A front door to the CMake presets. Where there is no apt-get: install the packages named by
# `scripts/setup --list` by hand and say `make SETUP=true`.
SETUP ?= scripts/setup
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
# How long each fuzz target runs.
FUZZ_SECONDS ?= 60
# Cleared, so that an inherited jobserver does not make Ninja run on one core.
BUILD = env -u MAKEFLAGS cmake --build --preset
RELEASE = build/release

.DEFAULT_GOAL := release
.PHONY: release setup demo test asan fuzz bench accuracy budget portable python wasm web format check install clean

release: setup $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS)

setup:
	@$(SETUP)

build/%/build.ninja: CMakePresets.json | setup
	cmake --preset $*
	@touch $@

demo: setup $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_demo
	$(RELEASE)/bin/dotpose_demo

test: release
	ctest --preset release -j $(JOBS)

asan: setup build/asan/build.ninja
	$(BUILD) asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)

# And the unit tests of what is fuzzed, under the same sanitizers.
fuzz: SETUP += --fuzz
fuzz: setup build/fuzz/build.ninja
	cmake --preset fuzz -DDOTPOSE_FUZZ_SECONDS=$(FUZZ_SECONDS)
	$(BUILD) fuzz -j $(JOBS) --target dotpose_fuzz dotpose_unit_tests
	ctest --preset fuzz -j $(JOBS)

bench: setup $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_bench dotpose_instructions
	$(RELEASE)/bin/dotpose_bench $(ARGS)
	bench/instructions $(if $(findstring --update,$(ARGS)),--update)

accuracy: setup $(RELEASE)/build.ninja
	$(BUILD) release -j $(JOBS) --target dotpose_accuracy
	$(RELEASE)/bin/dotpose_accuracy $(ARGS)

# With ARGS=--all: all sizes of frames and cores.
ifneq ($(findstring --all,$(ARGS)),)
more_frames = dotpose_frames_160x120 dotpose_frames_320x240
more_cores = cortex-m4f cortex-m33 rv32imc
endif
budget: SETUP += --firmware
budget: setup $(RELEASE)/build.ninja \
    $(patsubst %,build/%/build.ninja,cortex-m0plus mips32r2 $(more_cores))
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_frames dotpose_count dotpose_budget \
	    dotpose_golden_files $(more_frames)
	$(BUILD) cortex-m0plus -j $(JOBS)
	$(BUILD) mips32r2 -j $(JOBS)
	$(if $(more_cores),set -e; for core in cortex-m0plus mips32r2 $(more_cores); do \
	    $(BUILD) $$core -j $(JOBS) --target dotpose_firmware_of_all_sizes; done)
	firmware/budget $(ARGS)
	$(RELEASE)/bin/dotpose_golden_files build/budget/golden
	wrappers/c/device/run build/cortex-m0plus/wrappers/c/libdotpose_c.a build/budget/golden

portable: SETUP += --firmware
portable: setup
	scripts/check-portable
	tests/checks/portable_selftest scripts

wasm: SETUP += --wasm
wasm: setup $(RELEASE)/build.ninja
	wrappers/wasm/build
	$(BUILD) release -j $(JOBS) --target dotpose_cli dotpose_golden_files
	ctest --preset release -L wasm

web: SETUP += --wasm
web: setup $(RELEASE)/build.ninja
	wrappers/wasm/build
	web/build
	$(BUILD) release -j $(JOBS) --target dotpose_cli
	ctest --preset release -L web

# A wheel in build/python, and an environment with it, whose example is run. Configures again, as
# the packages may have been missing before.
PYTHON = /usr/bin/python3
python: SETUP += --python
python: setup
	cmake --preset release
	$(BUILD) release -j $(JOBS) --target dotpose_python
	rm -rf build/python
	DOTPOSE_BUILD=$(CURDIR)/$(RELEASE) $(PYTHON) -m build --wheel --no-isolation \
	    -o build/python wrappers/python
	$(PYTHON) -m venv --system-site-packages build/python/venv
	build/python/venv/bin/pip install --no-index build/python/*.whl
	build/python/venv/bin/python wrappers/python/examples/first.py
	@echo 'Begin: . build/python/venv/bin/activate'

format: setup
	scripts/format

check: setup $(RELEASE)/build.ninja
	scripts/format --check
	scripts/check-layers
	scripts/check-names
	scripts/check-pipeline
	$(BUILD) release -j $(JOBS) --target dotpose dotpose_golden
	scripts/golden-frames
	scripts/check-core-symbols $(RELEASE)/src/libdotpose.a

# No setup here: `sudo make install` after `make` only copies.
install:
	@test -f $(RELEASE)/src/libdotpose.a || { echo 'Nothing built yet: run make first.' >&2; exit 1; }
	cmake --install $(RELEASE) --prefix $(PREFIX)

clean:
	rm -rf build demo-out accuracy-out bench-out
