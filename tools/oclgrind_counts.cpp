// A plugin of oclgrind that counts what a kernel's instructions do: floating-point operations by
// their lanes, which `--inst-counts` does not tell, and bytes of global memory.
// scripts/kernel_counts.py builds and loads it.
//
// For every launch a line of JSON is appended to the file that WAVEPATH_COUNTS names. An addition,
// subtraction, multiplication or division counts as one operation a lane, as does a root or any
// other function of <math>; a fused multiply-add counts as two. Comparisons, minima, absolute
// values, negations and conversions count as none.
#include <llvm-c/Core.h>
#include <oclgrind/Context.h>
#include <oclgrind/Kernel.h>
#include <oclgrind/KernelInvocation.h>
#include <oclgrind/Memory.h>
#include <oclgrind/Plugin.h>

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <unordered_map>

namespace {

// "_Z3fmaDv8_fS_S_" -> "fma"; a name that is not mangled stays.
std::string builtin_name(const std::string& name) {
    if (name.rfind("_Z", 0) != 0) return name;
    std::size_t digits = 0;
    const std::size_t length = std::stoul(name.substr(2), &digits);
    return name.substr(2 + digits, length);
}

uint64_t operations_of_function(const std::string& name) {
    static const std::map<std::string, uint64_t> operations{
        {"fma", 2}, {"mad", 2}, {"sqrt", 1}, {"rsqrt", 1}, {"exp", 1},  {"exp2", 1},
        {"log", 1}, {"cos", 1}, {"sin", 1},  {"pow", 1},   {"acos", 1}, {"atan2", 1}};
    const auto found = operations.find(builtin_name(name));
    return found == operations.end() ? 0 : found->second;
}

// Kernels read their settings by pointers to constant memory, which oclgrind keeps in its global
// memory.
bool reads_constants(LLVMValueRef instruction) {
    for (int i = 0; i < LLVMGetNumOperands(instruction); ++i) {
        LLVMTypeRef type = LLVMTypeOf(LLVMGetOperand(instruction, static_cast<unsigned>(i)));
        if (LLVMGetTypeKind(type) == LLVMPointerTypeKind &&
            LLVMGetPointerAddressSpace(type) == oclgrind::AddrSpaceConstant)
            return true;
    }
    return false;
}

// What one execution of the instruction counts, a lane.
uint64_t operations_of(LLVMValueRef instruction) {
    switch (LLVMGetInstructionOpcode(instruction)) {
        case LLVMFAdd:
        case LLVMFSub:
        case LLVMFMul:
        case LLVMFDiv:
            return 1;
        case LLVMCall: {
            std::size_t length = 0;
            const char* name = LLVMGetValueName2(LLVMGetCalledValue(instruction), &length);
            return operations_of_function(std::string(name, length));
        }
        default:
            return 0;
    }
}

class Counts : public oclgrind::Plugin {
  public:
    explicit Counts(const oclgrind::Context* context) : Plugin(context) {}

    void kernelBegin(const oclgrind::KernelInvocation* /*invocation*/) override {
        known_.clear();  // instructions of another program may have taken their place
        flops_ = bytes_ = pending_ = 0;
    }

    // Comes after what the instruction loads and stores.
    void instructionExecuted(
        const oclgrind::WorkItem* /*item*/,
        const llvm::Instruction* instruction,
        const oclgrind::TypedValue& result) override {
        const auto [known, is_new] = known_.try_emplace(instruction);
        if (is_new) {
            auto* value =
                reinterpret_cast<LLVMValueRef>(const_cast<llvm::Instruction*>(instruction));
            known->second = {operations_of(value), reads_constants(value)};
        }
        if (known->second.operations > 0) flops_ += known->second.operations * result.num;
        if (!known->second.reads_constants) bytes_ += pending_;
        pending_ = 0;
    }

    void memoryLoad(
        const oclgrind::Memory* memory,
        const oclgrind::WorkItem* /*item*/,
        size_t /*address*/,
        size_t size) override {
        if (memory->getAddressSpace() == oclgrind::AddrSpaceGlobal) pending_ += size;
    }

    void memoryStore(
        const oclgrind::Memory* memory,
        const oclgrind::WorkItem* /*item*/,
        size_t /*address*/,
        size_t size,
        const uint8_t* /*data*/) override {
        if (memory->getAddressSpace() == oclgrind::AddrSpaceGlobal) pending_ += size;
    }

    void kernelEnd(const oclgrind::KernelInvocation* invocation) override {
        std::ofstream(std::getenv("WAVEPATH_COUNTS"), std::ios::app)
            << "{\"kernel\": \"" << invocation->getKernel()->getName()
            << "\", \"flops\": " << flops_ << ", \"bytes\": " << bytes_ << "}\n";
    }

    bool isThreadSafe() const override { return false; }

  private:
    struct Known {
        uint64_t operations = 0;
        bool reads_constants = false;
    };

    std::unordered_map<const llvm::Instruction*, Known> known_;
    uint64_t flops_ = 0, bytes_ = 0;  // of this launch
    uint64_t pending_ = 0;            // bytes of the instruction that is under way
};

Counts* counts = nullptr;

}  // namespace

extern "C" void initializePlugins(oclgrind::Context* context) {
    if (std::getenv("WAVEPATH_COUNTS") == nullptr) return;
    counts = new Counts(context);
    context->registerPlugin(counts);
}

extern "C" void releasePlugins(oclgrind::Context* context) {
    if (counts == nullptr) return;
    context->unregisterPlugin(counts);
    delete counts;
    counts = nullptr;
}
