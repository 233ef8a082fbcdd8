// The numbers that accessors are made of, in each of glTF's encodings.
#pragma once

#include <cstddef>
#include <cstdint>

namespace wavepath {

// Whether attributes may have numbers of this component type, and indices.
bool is_vertex_component(int component_type);
bool is_index_component(int component_type);

// [byte] of one number.
std::size_t component_size(int component_type);

// Numbers a row. 0 for the types that pad their columns: no attribute has them.
std::size_t component_count(int type);

// One number of a vertex component type; a normalized integer as its fraction.
float load_float(const unsigned char* bytes, int component_type, bool normalized);

// One number of an index component type.
std::uint32_t load_index(const unsigned char* bytes, int component_type);

// The index that starts a primitive anew, which glTF forbids.
std::uint32_t restart_value(int component_type);

}  // namespace wavepath
