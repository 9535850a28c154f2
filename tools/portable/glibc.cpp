// SPDX-License-Identifier: MIT
// The functions of glibc that have new versions since 2.31, by their old ones, so that what is linked here runs on
// releases of Linux since 2020. The linker calls `__wrap_NAME` where an object calls NAME (--wrap), and the old
// version is named by .symver; each has stood in every glibc for x86-64 since 2.2.5 (2.4, 2.30 where it says so),
// and its behaviour is the same.
//
// Since 2.34 the start of a program leaves it to glibc to run its constructors, which an older one does not do:
// `__libc_start_main` is given a function that runs them, as programs linked by older glibcs do.

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/stat.h>

#define ALEMBERT_OLD(name, version) __asm__(".symver old_" #name ", " #name "@GLIBC_" version)

extern "C" {

void* old_dlopen(const char*, int);
void* old_dlsym(void*, const char*);
int old_dlclose(void*);
char* old_dlerror();
int old_dladdr(const void*, Dl_info*);
double old_hypot(double, double);
int old_pthread_sigmask(int, const sigset_t*, sigset_t*);
int old___xstat(int, const char*, struct stat*);
int old___lxstat(int, const char*, struct stat*);
int old___fxstat(int, int, struct stat*);
int old___fxstatat(int, int, const char*, struct stat*, int);
int old_pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
int old_pthread_join(pthread_t, void**);
int old_pthread_detach(pthread_t);
int old_pthread_once(pthread_once_t*, void (*)());
int old_pthread_key_create(pthread_key_t*, void (*)(void*));
int old___pthread_key_create(pthread_key_t*, void (*)(void*));
int old_pthread_key_delete(pthread_key_t);
void* old_pthread_getspecific(pthread_key_t);
int old_pthread_setspecific(pthread_key_t, const void*);
int old_pthread_mutex_trylock(pthread_mutex_t*);
int old_pthread_cond_clockwait(pthread_cond_t*, pthread_mutex_t*, clockid_t, const struct timespec*);
int old_pthread_rwlock_rdlock(pthread_rwlock_t*);
int old_pthread_rwlock_wrlock(pthread_rwlock_t*);
int old_pthread_rwlock_unlock(pthread_rwlock_t*);

using Main = int(int, char**, char**);
int old___libc_start_main(Main*, int, char**, Main*, void (*)(), void (*)(), void*);

ALEMBERT_OLD(dlopen, "2.2.5");
ALEMBERT_OLD(dlsym, "2.2.5");
ALEMBERT_OLD(dlclose, "2.2.5");
ALEMBERT_OLD(dlerror, "2.2.5");
ALEMBERT_OLD(dladdr, "2.2.5");
ALEMBERT_OLD(hypot, "2.2.5");
ALEMBERT_OLD(pthread_sigmask, "2.2.5");
ALEMBERT_OLD(__xstat, "2.2.5");
ALEMBERT_OLD(__lxstat, "2.2.5");
ALEMBERT_OLD(__fxstat, "2.2.5");
ALEMBERT_OLD(__fxstatat, "2.4");
ALEMBERT_OLD(pthread_create, "2.2.5");
ALEMBERT_OLD(pthread_join, "2.2.5");
ALEMBERT_OLD(pthread_detach, "2.2.5");
ALEMBERT_OLD(pthread_once, "2.2.5");
ALEMBERT_OLD(pthread_key_create, "2.2.5");
ALEMBERT_OLD(__pthread_key_create, "2.2.5");
ALEMBERT_OLD(pthread_key_delete, "2.2.5");
ALEMBERT_OLD(pthread_getspecific, "2.2.5");
ALEMBERT_OLD(pthread_setspecific, "2.2.5");
ALEMBERT_OLD(pthread_mutex_trylock, "2.2.5");
ALEMBERT_OLD(pthread_cond_clockwait, "2.30");
ALEMBERT_OLD(pthread_rwlock_rdlock, "2.2.5");
ALEMBERT_OLD(pthread_rwlock_wrlock, "2.2.5");
ALEMBERT_OLD(pthread_rwlock_unlock, "2.2.5");
ALEMBERT_OLD(__libc_start_main, "2.2.5");

void* __wrap_dlopen(const char* file, int mode) {
    return old_dlopen(file, mode);
}
void* __wrap_dlsym(void* handle, const char* name) {
    return old_dlsym(handle, name);
}
int __wrap_dlclose(void* handle) {
    return old_dlclose(handle);
}
char* __wrap_dlerror() {
    return old_dlerror();
}
int __wrap_dladdr(const void* address, Dl_info* info) {
    return old_dladdr(address, info);
}
double __wrap_hypot(double x, double y) {
    return old_hypot(x, y);
}
int __wrap_pthread_sigmask(int how, const sigset_t* set, sigset_t* old) {
    return old_pthread_sigmask(how, set, old);
}

// The layout of `struct stat` has number 1.
int __wrap_stat(const char* path, struct stat* to) {
    return old___xstat(1, path, to);
}
int __wrap_lstat(const char* path, struct stat* to) {
    return old___lxstat(1, path, to);
}
int __wrap_fstat(int file, struct stat* to) {
    return old___fxstat(1, file, to);
}
int __wrap_fstat64(int file, struct stat64* to) {  // the same layout
    return old___fxstat(1, file, reinterpret_cast<struct stat*>(to));
}
int __wrap_fstatat(int folder, const char* path, struct stat* to, int flags) {
    return old___fxstatat(1, folder, path, to, flags);
}

int __wrap_pthread_create(pthread_t* thread, const pthread_attr_t* with, void* (*run)(void*), void* argument) {
    return old_pthread_create(thread, with, run, argument);
}
int __wrap_pthread_join(pthread_t thread, void** result) {
    return old_pthread_join(thread, result);
}
int __wrap_pthread_detach(pthread_t thread) {
    return old_pthread_detach(thread);
}
int __wrap_pthread_once(pthread_once_t* once, void (*run)()) {
    return old_pthread_once(once, run);
}
int __wrap_pthread_key_create(pthread_key_t* key, void (*destroy)(void*)) {
    return old_pthread_key_create(key, destroy);
}
int __wrap___pthread_key_create(pthread_key_t* key, void (*destroy)(void*)) {
    return old___pthread_key_create(key, destroy);
}
int __wrap_pthread_key_delete(pthread_key_t key) {
    return old_pthread_key_delete(key);
}
void* __wrap_pthread_getspecific(pthread_key_t key) {
    return old_pthread_getspecific(key);
}
int __wrap_pthread_setspecific(pthread_key_t key, const void* value) {
    return old_pthread_setspecific(key, value);
}
int __wrap_pthread_mutex_trylock(pthread_mutex_t* mutex) {
    return old_pthread_mutex_trylock(mutex);
}
int __wrap_pthread_cond_clockwait(pthread_cond_t* on, pthread_mutex_t* mutex, clockid_t clock,
                                  const struct timespec* until) {
    return old_pthread_cond_clockwait(on, mutex, clock, until);
}
int __wrap_pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
    return old_pthread_rwlock_rdlock(lock);
}
int __wrap_pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
    return old_pthread_rwlock_wrlock(lock);
}
int __wrap_pthread_rwlock_unlock(pthread_rwlock_t* lock) {
    return old_pthread_rwlock_unlock(lock);
}

// Tells libstdc++ whether counters of references need no atomic instructions; 0 is always right.
char __wrap___libc_single_threaded = 0;

// Since 2.36: a random number for std::random_device.
uint32_t __wrap_arc4random() {
    uint32_t number = 0;
    while (getrandom(&number, sizeof number, 0) != sizeof number) {
    }
    return number;
}

// Since 2.35: where the tables for exceptions stand of the object that holds an address.
int __wrap__dl_find_object(void* address, struct dl_find_object* found) {
    struct Search {
        ElfW(Addr) address;
        struct dl_find_object* found;
    } search{reinterpret_cast<ElfW(Addr)>(address), found};
    const auto look = [](struct dl_phdr_info* object, size_t, void* data) -> int {
        const Search& search = *static_cast<Search*>(data);
        const ElfW(Phdr)* tables = nullptr;
        bool is_inside = false;
        for (int k = 0; k < object->dlpi_phnum; ++k) {
            const ElfW(Phdr)& part = object->dlpi_phdr[k];
            const ElfW(Addr) begin = object->dlpi_addr + part.p_vaddr;
            if (part.p_type == PT_LOAD && search.address >= begin && search.address < begin + part.p_memsz) {
                is_inside = true;
                search.found->dlfo_map_start = reinterpret_cast<void*>(begin);
                search.found->dlfo_map_end = reinterpret_cast<void*>(begin + part.p_memsz);
            }
            if (part.p_type == PT_GNU_EH_FRAME) tables = &part;
        }
        if (!is_inside || tables == nullptr) return 0;
        search.found->dlfo_flags = 0;
        search.found->dlfo_link_map = nullptr;
        search.found->dlfo_eh_frame = reinterpret_cast<void*>(object->dlpi_addr + tables->p_vaddr);
        return 1;
    };
    return dl_iterate_phdr(look, &search) == 1 ? 0 : -1;
}

extern Main* __preinit_array_start[];
extern Main* __preinit_array_end[];
extern Main* __init_array_start[];
extern Main* __init_array_end[];
void _init();

static int run_constructors(int count, char** arguments, char** environment) {
    for (Main** one = __preinit_array_start; one != __preinit_array_end; ++one)
        (*one)(count, arguments, environment);
    _init();
    for (Main** one = __init_array_start; one != __init_array_end; ++one) (*one)(count, arguments, environment);
    return 0;
}

int __wrap___libc_start_main(Main* run, int count, char** arguments, Main*, void (*)(), void (*at_exit)(),
                             void* stack) {
    return old___libc_start_main(run, count, arguments, run_constructors, nullptr, at_exit, stack);
}

}  // extern "C"
