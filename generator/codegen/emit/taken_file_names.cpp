// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/taken_file_names.hpp"

#include <set>

namespace alembert {

namespace {

/// A scene's header would stand before these of the compiler, which its own files include or whose headers do,
/// where its folder is given to the compiler.
bool is_header_of_c(const std::string& name) {
    static const std::set<std::string> headers{
        "alloca",   "assert",  "complex",   "ctype",   "endian", "errno",  "features", "fenv",   "float",
        "inttypes", "iso646",  "limits",    "locale",  "malloc", "math",   "memory",   "setjmp", "signal",
        "stdalign", "stdarg",  "stdatomic", "stdbool", "stddef", "stdint", "stdio",    "stdlib", "stdnoreturn",
        "string",   "strings", "tgmath",    "threads", "time",   "uchar",  "unistd",   "wchar",  "wctype"};
    return headers.contains(name);
}

/// A scene's module would hide these: sys.stdlib_module_names of Python 3.11, and what emitted files import.
bool is_module_of_python(const std::string& name) {
    static const std::set<std::string> modules{
        "abc",           "aifc",         "antigravity",  "argparse",    "array",       "ast",
        "asynchat",      "asyncio",      "asyncore",     "atexit",      "audioop",     "base64",
        "bdb",           "binascii",     "bisect",       "builtins",    "bz2",         "cProfile",
        "calendar",      "cgi",          "cgitb",        "chunk",       "cmath",       "cmd",
        "code",          "codecs",       "codeop",       "collections", "colorsys",    "compileall",
        "concurrent",    "configparser", "contextlib",   "contextvars", "copy",        "copyreg",
        "crypt",         "csv",          "ctypes",       "curses",      "dataclasses", "datetime",
        "dbm",           "decimal",      "difflib",      "dis",         "distutils",   "doctest",
        "email",         "encodings",    "ensurepip",    "enum",        "errno",       "faulthandler",
        "fcntl",         "filecmp",      "fileinput",    "fnmatch",     "fractions",   "ftplib",
        "functools",     "gc",           "genericpath",  "getopt",      "getpass",     "gettext",
        "glob",          "graphlib",     "grp",          "gzip",        "hashlib",     "heapq",
        "hmac",          "html",         "http",         "idlelib",     "imaplib",     "imghdr",
        "imp",           "importlib",    "inspect",      "io",          "ipaddress",   "itertools",
        "jax",           "json",         "keyword",      "lib2to3",     "linecache",   "locale",
        "logging",       "lzma",         "mailbox",      "mailcap",     "marshal",     "math",
        "mimetypes",     "mmap",         "modulefinder", "msilib",      "msvcrt",      "multiprocessing",
        "netrc",         "nis",          "nntplib",      "nt",          "ntpath",      "nturl2path",
        "numbers",       "numpy",        "opcode",       "operator",    "optparse",    "os",
        "ossaudiodev",   "pathlib",      "pdb",          "pickle",      "pickletools", "pipes",
        "pkgutil",       "platform",     "plistlib",     "poplib",      "posix",       "posixpath",
        "pprint",        "profile",      "pstats",       "pty",         "pwd",         "py_compile",
        "pyclbr",        "pydoc",        "pydoc_data",   "pyexpat",     "queue",       "quopri",
        "random",        "re",           "readline",     "reprlib",     "resource",    "rlcompleter",
        "runpy",         "sched",        "secrets",      "select",      "selectors",   "shelve",
        "shlex",         "shutil",       "signal",       "site",        "smtpd",       "smtplib",
        "sndhdr",        "socket",       "socketserver", "spwd",        "sqlite3",     "sre_compile",
        "sre_constants", "sre_parse",    "ssl",          "stat",        "statistics",  "string",
        "stringprep",    "struct",       "subprocess",   "sunau",       "symtable",    "sys",
        "sysconfig",     "syslog",       "tabnanny",     "tarfile",     "telnetlib",   "tempfile",
        "termios",       "textwrap",     "this",         "threading",   "time",        "timeit",
        "tkinter",       "token",        "tokenize",     "tomllib",     "trace",       "traceback",
        "tracemalloc",   "tty",          "turtle",       "turtledemo",  "types",       "typing",
        "unicodedata",   "unittest",     "urllib",       "uu",          "uuid",        "venv",
        "warnings",      "wave",         "weakref",      "webbrowser",  "winreg",      "winsound",
        "wsgiref",       "xdrlib",       "xml",          "xmlrpc",      "zipapp",      "zipfile",
        "zipimport",     "zlib",         "zoneinfo"};
    return modules.contains(name);
}

}  // namespace

bool is_taken_file_name(const std::string& name, CodeLanguage language) {
    return (language == CodeLanguage::c && is_header_of_c(name)) ||
           (language == CodeLanguage::python && is_module_of_python(name));
}

}  // namespace alembert
