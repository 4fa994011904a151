# The two commands a newcomer needs are `make demo` and `make test`; on a bare Debian 12 they install what is missing
# (.ci/packages.txt). Everything else is CMake: see CMakePresets.json.
JOBS ?= $(shell nproc)

.PHONY: help demo gallery test build asan tsan core fuzz bench format tidy docs install clean
help:
	@echo "make demo      compile the standard shaders, test one, render docs/demo/demo.rib"
	@echo "make gallery   render the scenes of docs/gallery, and a page with pictures and times"
	@echo "make test      build with assertions and run all tests"
	@echo "make asan      the same under the address and undefined-behaviour sanitizers (tsan: threads)"
	@echo "make core      compiler, virtual machine and their tests only, without renderer"
	@echo "make bench     ns per point beside hand-written code"
	@echo "make fuzz      a minute of fuzzing for each parser (needs clang)"
	@echo "make format    clang-format, in place; make tidy: clang-tidy"
	@echo "make docs      the generated pages of docs/"
	@echo "make install   to PREFIX (/usr/local)"

# $(call build,PRESET[,TARGETS]): installs, configures, builds.
define build
	@.ci/install-deps
	@cmake --preset $(1) --log-level=WARNING >/dev/null
	@cmake --build --preset $(1) -j $(JOBS) $(if $(2),--target $(2))
endef

build:
	$(call build,release)

demo:
	$(call build,release,tools)
	@.ci/demo build/release

# One pass at a time, so that times can be compared.
gallery:
	$(call build,release,tools)
	@build/release/bin/slpass -j 1 -o build/gallery --page build/gallery/index.html $(dir $(wildcard docs/gallery/*/passes.toml))
	@echo "The page is build/gallery/index.html"

test:
	$(call build,relassert)
	@ctest --preset relassert -j $(JOBS)

asan tsan core:
	$(call build,$@)
	@ctest --preset $@ -j $(JOBS)

bench:
	$(call build,release,anemone_bench)
	@build/release/bin/anemone_bench

fuzz:
	@.ci/install-deps clang libclang-rt-dev
	$(call build,fuzz)
	@.ci/fuzz build/fuzz

docs:
	$(call build,relassert,generated_docs)

format:
	@.ci/install-deps clang-format
	@git ls-files '*.cpp' '*.h' | grep -Ev '^(tests/(diagnostics|language|tools)|stdlib|shaders)/.*\.h$$' | xargs clang-format -i

tidy:
	@.ci/install-deps clang-tidy
	$(call build,relassert)
	@git ls-files 'slc/*.cpp' 'slvm/*.cpp' 'render/*.cpp' | grep -v '^slvm/kernels/' | \
	  xargs -P $(JOBS) -n 4 clang-tidy -p build/relassert --quiet --extra-arg=-Wno-unknown-warning-option

PREFIX ?= /usr/local
install:
	$(call build,release,tools)
	@cmake --install build/release --prefix $(PREFIX) >/dev/null
	@echo "Installed to $(PREFIX)"

clean:
	@rm -rf build/release build/relassert build/debug build/asan build/tsan build/core build/fuzz
