#include "wavefront/stage.h"

namespace wavepath {

Stage::Stage(
    const cl::Program& program,
    const std::string& source,
    const std::string& name,
    const KernelBuffers& buffers,
    LaunchSize size,
    Profile& profile)
    : parameters_(kernel_signature(source, name)),
      name_(name),
      kernel_(program, name.c_str()),
      size_(size),
      profile_(profile),
      row_(profile.row(name)) {
    for (cl_uint i = 0; i < parameters_.size(); ++i)
        if (parameters_[i].is_buffer)
            kernel_.setArg(i, buffers.of(name, parameters_[i]));
        else
            numbers_.push_back(i);
}

void Stage::rebind(const KernelBuffers& buffers) {
    for (cl_uint i = 0; i < parameters_.size(); ++i)
        if (parameters_[i].is_buffer && buffers.has(parameters_[i].name))
            kernel_.setArg(i, buffers.of(name_, parameters_[i]));
}

void Stage::launch(const Device& device, uint64_t slots, std::initializer_list<cl_uint> numbers) {
    if (slots == 0) return;
    if (numbers.size() != numbers_.size())
        throw Error("kernel {}: takes {} numbers, not {}", name_, numbers_.size(), numbers.size());
    std::size_t next = 0;
    for (const cl_uint number : numbers) kernel_.setArg(numbers_[next++], number);
    const uint64_t slots_per_group = uint64_t{size_.local_size} * size_.slots_per_item;
    const uint64_t groups = (slots + slots_per_group - 1) / slots_per_group;
    cl::Event event;
    device.queue.enqueueNDRangeKernel(
        kernel_, cl::NullRange, cl::NDRange(groups * size_.local_size),
        cl::NDRange(size_.local_size), nullptr, &event);
    profile_.add(row_, slots, event);
}

}  // namespace wavepath
