// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-hdf5.so: see base/archive/hdf5.hpp.
#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "base/archive/hdf5.hpp"

namespace alembert {

namespace {

/// An identifier of HDF5, closed at the end.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }  // NOLINT: it is what HDF5 takes

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// Texts of one length, filled with zeros, as HDF5 takes them.
struct Texts {
    std::size_t longest = 1;
    std::string bytes;
    explicit Texts(const std::vector<std::string>& list) {
        for (const std::string& text : list) longest = std::max(longest, text.size());
        for (const std::string& text : list) bytes += text + std::string(longest - text.size(), '\0');
    }
    hid_t type() const {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, longest);
        H5Tset_strpad(type, H5T_STR_NULLPAD);
        H5Tset_cset(type, H5T_CSET_UTF8);
        return type;
    }
};

bool add_attribute(hid_t to, const char* name, const std::vector<std::string>& list, bool is_one) {
    const Texts texts(list);
    const Handle type(texts.type(), H5Tclose);
    const hsize_t count = list.size();
    const Handle space(is_one ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
    const Handle attribute(H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    return attribute >= 0 && H5Awrite(attribute, type, texts.bytes.data()) >= 0;
}

bool add_column(hid_t file, const StoredColumn& column) {
    const hsize_t count = std::visit([](const auto& list) { return list.size(); }, column.values);
    const auto* numbers = std::get_if<std::vector<double>>(&column.values);
    const auto* counts = std::get_if<std::vector<std::int64_t>>(&column.values);
    const Texts texts(numbers == nullptr && counts == nullptr ? std::get<std::vector<std::string>>(column.values)
                                                              : std::vector<std::string>{});
    const Handle of_texts(texts.type(), H5Tclose), space(H5Screate_simple(1, &count, nullptr), H5Sclose),
        properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);  // the same table gives the same bytes
    const hid_t type = numbers != nullptr ? H5T_IEEE_F64LE : counts != nullptr ? H5T_STD_I64LE : hid_t{of_texts};
    const hid_t here = numbers != nullptr  ? H5T_NATIVE_DOUBLE
                       : counts != nullptr ? H5T_NATIVE_LONG
                                           : hid_t{of_texts};
    const void* const data = numbers != nullptr  ? static_cast<const void*>(numbers->data())
                             : counts != nullptr ? static_cast<const void*>(counts->data())
                                                 : texts.bytes.data();
    const Handle set(H5Dcreate2(file, column.name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                     H5Dclose);
    return set >= 0 && (count == 0 || H5Dwrite(set, here, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0) &&
           add_attribute(set, "unit", {column.unit}, true);
}

/// The memory in which HDF5 makes a file; `bytes` get what is in it when the file is closed. (H5Fget_file_image
/// gives an open file another mark in its superblock than the one for which the checksum beside it was taken, so
/// that no HDF5 reads it.)
struct Image {
    std::string& bytes;
    std::size_t size = 0;

    static void* resized(void* memory, std::size_t size, H5FD_file_image_op_t, void* image) {
        auto& of = *static_cast<Image*>(image);
        auto* const begin = static_cast<char*>(std::realloc(memory, size));
        if (begin != nullptr && size > of.size)  // the same table gives the same bytes
            std::memset(begin + of.size, 0, size - of.size);
        if (begin != nullptr) of.size = size;
        return begin;
    }
    static herr_t freed(void* memory, H5FD_file_image_op_t why, void* image) {
        auto& of = *static_cast<Image*>(image);
        if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) of.bytes.assign(static_cast<const char*>(memory), of.size);
        std::free(memory);
        return 0;
    }
    H5FD_file_image_callbacks_t callbacks() {
        return {.image_malloc = [](std::size_t size, H5FD_file_image_op_t why,
                                   void* image) { return resized(nullptr, size, why, image); },
                .image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t,
                                   void*) { return std::memcpy(to, from, size); },
                .image_realloc = resized,
                .image_free = freed,
                .udata_copy = [](void* image) { return image; },
                .udata_free = [](void*) -> herr_t { return 0; },
                .udata = this};
    }
};

/// Adds the columns and the texts.
bool filled(hid_t file, const StoredTable& table) {
    std::vector<std::string> names;
    for (const StoredColumn& column : table.columns) {
        names.push_back(column.name);
        if (!add_column(file, column)) return false;
    }
    if (!add_attribute(file, "columns", names, false)) return false;
    for (const auto& [name, text] : table.texts)
        if (!add_attribute(file, name.c_str(), {text}, true)) return false;
    return true;
}

bool written(const StoredTable& table, std::string& bytes) {
    constexpr std::size_t piece = 1 << 20;
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    Image image{bytes};
    H5FD_file_image_callbacks_t callbacks = image.callbacks();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, piece, false);  // in memory: the program writes all its files in one way
    H5Pset_file_image_callbacks(access, &callbacks);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);  // texts of any length as attributes
    const hid_t file = H5Fcreate("table.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (file < 0) return false;
    const bool is_filled = filled(file, table) && H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);  // the memory is larger
    if (H5Fclose(file) < 0 || !is_filled || size <= 0 || static_cast<std::size_t>(size) > bytes.size())
        return false;
    bytes.resize(static_cast<std::size_t>(size));
    return true;
}

}  // namespace

}  // namespace alembert

extern "C" bool alembert_hdf5(const alembert::StoredTable& table, std::string& bytes) {
    return alembert::written(table, bytes);
}
