// QEMU plugin that counts the instructions of each frame, separately for each stage of the locator.
//
//   qemu-... -plugin ./libdotpose_count.so,stages=FILE,out=FILE
//
// The plugin counts the instructions between the markers `resume` and `pause` from markers.hpp,
// excluding the markers themselves. The stage file consists of lines "ADDRESS NAME" with
// hexadecimal addresses. The stage NAME begins at the instruction at ADDRESS and ends when the next
// stage begins. Instructions between `resume` and the first stage belong to the stage "other". The
// output has one line with the names of the stages, and one line of counts for each marker
// `end_frame`.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>

// Declarations for version 1 of the plugin interface ("QEMU TCG Plugins" in QEMU's documentation).
// Debian has no package with the plugin header.
extern "C" {

using qemu_plugin_id_t = std::uint64_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t {
    const char* target_name;
    struct {
        int min, cur;
    } version;
    bool system_emulation;
    struct {
        int smp_vcpus, max_vcpus;
    } system;
};
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
using qemu_plugin_vcpu_tb_trans_cb_t = void (*)(qemu_plugin_id_t, qemu_plugin_tb*);
using qemu_plugin_vcpu_udata_cb_t = void (*)(unsigned vcpu, void*);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, qemu_plugin_vcpu_tb_trans_cb_t);
void qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_insn*, qemu_plugin_vcpu_udata_cb_t,
                                            qemu_plugin_cb_flags, void*);
void qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_insn*, qemu_plugin_op, void*,
                                                std::uint64_t);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
const void* qemu_plugin_insn_data(const qemu_plugin_insn*);
std::size_t qemu_plugin_insn_size(const qemu_plugin_insn*);
std::uint64_t qemu_plugin_insn_vaddr(const qemu_plugin_insn*);

[[gnu::visibility("default")]] extern int qemu_plugin_version;
int qemu_plugin_version = 1;

[[gnu::visibility("default")]] int qemu_plugin_install(qemu_plugin_id_t, const qemu_info_t*, int,
                                                       char**);
}

namespace {

struct Stage {
    std::uint64_t address = 0;
    std::string name;
    std::uint64_t count = 0;  ///< number of instructions in the current frame
};

/// State of the plugin. The only instance is global, because QEMU passes only one pointer to
/// callbacks. The emulated machine has one processor, so all callbacks run in one thread.
struct Counter {
    std::deque<Stage> stages = {{0, "other"}};
    Stage* current = &stages.front();
    std::uint64_t executed = 0;  ///< number of instructions since the start
    std::uint64_t credited = 0;  ///< value of `executed` at the last change of stage
    bool is_counting = false;
    std::ofstream out;

    void credit() {
        if (is_counting) current->count += executed - credited;
        credited = executed;
    }
} counter;

void on_resume(unsigned /*vcpu*/, void* /*data*/) {
    counter.credit();
    counter.is_counting = true;
    counter.current = &counter.stages.front();
}

void on_pause(unsigned /*vcpu*/, void* /*data*/) {
    counter.credit();
    counter.is_counting = false;
}

void on_end_frame(unsigned /*vcpu*/, void* /*data*/) {
    for (Stage& stage : counter.stages) {
        counter.out << stage.count << ' ';
        stage.count = 0;
    }
    counter.out << '\n' << std::flush;
    if (counter.out) return;
    std::fputs("dotpose_count: cannot write the counts\n", stderr);
    std::_Exit(1);
}

void on_enter(unsigned /*vcpu*/, void* stage) {
    counter.credit();
    counter.current = static_cast<Stage*>(stage);
}

struct Marker {
    std::uint32_t encoding;
    std::size_t size;
    qemu_plugin_vcpu_udata_cb_t call;
};
using Markers = std::array<Marker, 3>;

// The markers are the instructions mov r10, r10; mov r11, r11; mov r12, r12.
constexpr Markers kThumbMarkers = {
    {{0x46D2, 2, on_resume}, {0x46DB, 2, on_pause}, {0x46E4, 2, on_end_frame}}};
// The markers are the microMIPS instructions sltiu $0, $0, N, where N is 0x1b1, 0x1b2 or 0x1b3.
constexpr Markers kMipsMarkers = {
    {{0x01B1B000, 4, on_resume}, {0x01B2B000, 4, on_pause}, {0x01B3B000, 4, on_end_frame}}};
// The markers are the instructions slti x0, x0, N, where N is 0x1b1, 0x1b2 or 0x1b3.
constexpr Markers kRiscVMarkers = {
    {{0x1B102013, 4, on_resume}, {0x1B202013, 4, on_pause}, {0x1B302013, 4, on_end_frame}}};
const Markers* markers = &kThumbMarkers;

const Marker* marker_at(const qemu_plugin_insn* instruction) {
    const std::size_t size = qemu_plugin_insn_size(instruction);
    // The bytes need not be swapped, because targets and host are little-endian.
    std::uint32_t encoding = 0;
    std::memcpy(&encoding, qemu_plugin_insn_data(instruction), std::min(size, sizeof encoding));
    const auto found = std::ranges::find_if(
        *markers, [&](const Marker& m) { return m.size == size && m.encoding == encoding; });
    return found == markers->end() ? nullptr : &*found;
}

void instrument(qemu_plugin_insn* instruction) {
    if (const Marker* marker = marker_at(instruction)) {
        qemu_plugin_register_vcpu_insn_exec_cb(instruction, marker->call, QEMU_PLUGIN_CB_NO_REGS,
                                               nullptr);
        return;
    }
    const auto stage =
        std::ranges::find(counter.stages, qemu_plugin_insn_vaddr(instruction), &Stage::address);
    if (stage != counter.stages.end() && stage != counter.stages.begin()) {
        qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_enter, QEMU_PLUGIN_CB_NO_REGS,
                                               &*stage);
    }
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, QEMU_PLUGIN_INLINE_ADD_U64,
                                               &counter.executed, 1);
}

void on_translate(qemu_plugin_id_t /*id*/, qemu_plugin_tb* block) {
    for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i)
        instrument(qemu_plugin_tb_get_insn(block, i));
}

bool read_stages(const std::string& path) {
    std::ifstream file(path);
    Stage stage;
    while (file >> std::hex >> stage.address >> stage.name)
        counter.stages.push_back(stage);
    return file.eof();
}

bool take_argument(std::string_view argument) {
    const std::size_t split = std::min(argument.find('='), argument.size() - 1);
    const std::string_view key = argument.substr(0, split);
    const std::string value(argument.substr(split + 1));
    if (key == "stages") return read_stages(value);
    if (key != "out") return false;
    counter.out.open(value);
    return counter.out.is_open();
}

}  // namespace

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
    const std::string_view target = info->target_name;
    if (target.starts_with("mips")) markers = &kMipsMarkers;
    if (target.starts_with("riscv")) markers = &kRiscVMarkers;
    for (int i = 0; i < argc; ++i) {
        if (take_argument(argv[i])) continue;
        std::fprintf(stderr, "dotpose_count: cannot use '%s'\n", argv[i]);
        return 1;
    }
    for (const Stage& stage : counter.stages)
        counter.out << stage.name << ' ';
    counter.out << '\n';
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
    return 0;
}
