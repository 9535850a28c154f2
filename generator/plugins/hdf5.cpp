// SPDX-License-Identifier: GPL-2.0-or-later
// alembert-hdf5.so: see base/archive/hdf5.hpp.
#include <hdf5.h>

#include <algorithm>
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

bool written(const StoredTable& table, std::string& bytes) {
    constexpr std::size_t piece = 1 << 20;
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, piece, false);  // in memory: the program writes all its files in one way
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);  // texts of any length as attributes
    const Handle file(H5Fcreate("table.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    if (file < 0) return false;
    std::vector<std::string> names;
    for (const StoredColumn& column : table.columns) {
        names.push_back(column.name);
        if (!add_column(file, column)) return false;
    }
    if (!add_attribute(file, "columns", names, false)) return false;
    for (const auto& [name, text] : table.texts)
        if (!add_attribute(file, name.c_str(), {text}, true)) return false;
    if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) return false;
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    if (size <= 0) return false;
    bytes.resize(static_cast<std::size_t>(size));
    return H5Fget_file_image(file, bytes.data(), bytes.size()) == size;
}

}  // namespace

}  // namespace alembert

extern "C" bool alembert_hdf5(const alembert::StoredTable& table, std::string& bytes) {
    return alembert::written(table, bytes);
}
