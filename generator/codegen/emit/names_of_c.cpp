// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <string>

#include "codegen/emit/reserved_words.hpp"

namespace alembert {

namespace {

// What the headers of C++, POSIX and glibc declare outside of any namespace and is no macro (those of Debian 12);
// without names that begin or end as below. A test holds it against the compiler's headers.
// clang-format off
constexpr std::string_view names =
    " Dl_info Dl_serinfo Dl_serpath Lmid_t a64l abort abs accept accept4 access acct acos active_reg_t addrinfo"
    " addseverity adjtime aiocb aioinit alarm aligned_alloc alloca alphasort arc4random arc4random_buf"
    " arc4random_uniform asctime asin asprintf at_quick_exit atan atan2 atexit atof atoi atol backtrace"
    " backtrace_symbols backtrace_symbols_fd basename bcmp bcopy bind bind_textdomain_codeset bindresvport"
    " bindresvport6 bindtextdomain blkcnt64_t blkcnt_t blksize_t brk bsearch btowc bzero c16rtomb c32rtomb"
    " c8rtomb caddr_t calloc canonicalize canonicalize_file_name catclose catgets catopen cc_t cfgetispeed"
    " cfgetospeed cfmakeraw cfsetispeed cfsetospeed cfsetspeed chdir chmod chown chroot clearenv clearerr clock"
    " clock_adjtime clock_getcpuclockid clock_getres clock_gettime clock_nanosleep clock_settime clock_t"
    " clockid_t clone close close_range closedir closefrom closelog cmsghdr comparison_fn_t confstr connect"
    " cookie_close_function_t cookie_io_functions_t cookie_read_function_t cookie_seek_function_t"
    " cookie_write_function_t copy_file_range cos cosh cpu_set_t creat crypt ctermid ctime cuserid daddr_t"
    " daemon daylight dcgettext dcngettext dev_t dgettext difftime dirent dirfd dirname div div_t dl_find_object"
    " dladdr dladdr1 dlclose dlerror dlinfo dlmopen dlopen dlsym dlvsym dngettext double_t dprintf drand48"
    " drand48_data drem dup dup2 dup3 duplocale dysize eaccess ecvt endgrent endhostent endnetent endnetgrent"
    " endorder endprotoent endpwent endrpcent endservent endusershell endutxent entry environ erand48 err error"
    " error_at_line error_message_count error_one_per_line error_print_progname error_t errx euidaccess execl"
    " execle execlp execv execve execveat execvp execvpe exit exp explicit_bzero f_owner_ex fabs faccessat"
    " fallocate fchdir fchmod fchmodat fchown fchownat fclose fcloseall fcntl fcvt fd_mask fd_set fdatasync"
    " fdopen fdopendir feclearexcept fedisableexcept feenableexcept fegetenv fegetexcept fegetexceptflag"
    " fegetmode fegetround feholdexcept femode_t fenv_t feof feraiseexcept ferror fesetenv fesetexcept"
    " fesetexceptflag fesetmode fesetround fetestexcept fetestexceptflag feupdateenv fexcept_t fexecve fflush"
    " ffs fgetc fgetgrent fgetpos fgetpwent fgets fgetwc fgetws file_handle fileno finite float_t flock"
    " flockfile fmemopen fmtmsg fnmatch fopen fopencookie fork fpathconf fpos64_t fpos_t fpregset_t fprintf"
    " fputc fputs fputwc fputws fread free freeaddrinfo freelocale freopen fsblkcnt64_t fsblkcnt_t fscanf"
    " fsconfig fsconfig_command fseek fseeko fsetpos fsfilcnt64_t fsfilcnt_t fsid_t fsmount fsopen fspick fstat"
    " fstatat fstatvfs fsync ftell ftello ftok ftruncate ftrylockfile ftw funlockfile futimens futimes futimesat"
    " fwide fwprintf fwrite fwscanf gai_cancel gai_error gai_strerror gai_suspend gaicb gamma gcvt"
    " get_avphys_pages get_current_dir_name get_nprocs get_nprocs_conf get_phys_pages getaddrinfo getaddrinfo_a"
    " getc getchar getcpu getcwd getdate getdate_err getdelim getdents64 getdirentries getdomainname"
    " getdtablesize getegid getentropy getenv geteuid getgid getgrent getgrgid getgrnam getgrouplist getgroups"
    " gethostbyaddr gethostbyname gethostbyname2 gethostent gethostid gethostname getipv4sourcefilter getitimer"
    " getline getloadavg getlogin getnameinfo getnetbyaddr getnetbyname getnetent getnetgrent getopt getopt_long"
    " getopt_long_only getpagesize getpass getpayload getpeername getpgid getpgrp getpid getppid getpriority"
    " getprotobyname getprotobynumber getprotoent getpt getpw getpwent getpwnam getpwuid getresgid getresuid"
    " getrlimit getrpcbyname getrpcbynumber getrpcent getrusage getservbyname getservbyport getservent getsid"
    " getsockname getsockopt getsourcefilter getsubopt gettext gettid gettimeofday getuid getumask getusershell"
    " getutmp getutmpx getutxent getutxid getutxline getw getwc getwchar getwd gid_t glob glob64_t"
    " glob_pattern_p glob_t globfree gmtime grantpt greg_t gregset_t group group_filter group_member group_req"
    " group_source_req gsignal hcreate hdestroy herror hostent hsearch hsearch_data hstrerror htonl htons iconv"
    " id_t idtype_t if_freenameindex if_indextoname if_nameindex if_nametoindex iface ifaddr ifconf ifmap ifreq"
    " imaxabs imaxdiv imaxdiv_t in6_addr in6_pktinfo in6addr_any in6addr_loopback in_addr in_addr_t in_pktinfo"
    " in_port_t index initgroups initstate innetgr ino64_t ino_t insque int16_t int32_t int64_t int8_t"
    " int_fast16_t int_fast32_t int_fast64_t int_fast8_t int_least16_t int_least32_t int_least64_t int_least8_t"
    " intmax_t intptr_t ioctl iovec ip6_mtuinfo ip_mreq ip_mreq_source ip_mreqn ip_msfilter ip_opts ipc_perm"
    " ipv6_mreq iruserok iruserok_af isatty isctype isfdtype iswalnum iswalpha iswblank iswcntrl iswctype"
    " iswdigit iswgraph iswlower iswprint iswpunct iswspace iswupper iswxdigit itimerspec itimerval j0 j1"
    " jmp_buf jn jrand48 key_t kill killpg l64a labs lchmod lchown lcong48 lconv ldiv ldiv_t leaf lerp lfind"
    " lgamma_r lgammaf128_r lgammaf32_r lgammaf32x_r lgammaf64_r lgammaf64x_r lgammaf_r lgammal_r linger link"
    " link_map linkat listen llabs lldiv lldiv_t locale_t localeconv localtime lockf loff_t log longjmp lrand48"
    " lsearch lseek lstat lutimes madvise mallinfo mallinfo2 malloc malloc_info malloc_stats malloc_trim"
    " malloc_usable_size mallopt max_align_t mblen mbrlen mbrtoc16 mbrtoc32 mbrtoc8 mbrtowc mbsinit mbsnrtowcs"
    " mbsrtowcs mbstate_t mbstowcs mbtowc mcontext_t memalign memccpy memchr memcmp memcpy memfd_create memfrob"
    " memmem memmove mempcpy memrchr memset mincore mkdir mkdirat mkdtemp mkfifo mkfifoat mknod mknodat mkostemp"
    " mkostemps mkstemp mkstemps mktemp mktime mlock mlock2 mlockall mmap mmsghdr mode_t modf mount mount_attr"
    " mount_setattr move_mount mprotect mqd_t mrand48 mremap msgbuf msgctl msgget msghdr msginfo msglen_t"
    " msgqnum_t msgrcv msgsnd msqid_ds msync munlock munlockall munmap name_to_handle_at nan nanosleep netent"
    " newlocale nfds_t nftw ngettext nice nl_catd nl_item nl_langinfo nlink_t nrand48 ntohl ntohs nullptr_t"
    " obstack obstack_printf obstack_vprintf off64_t off_t on_exit open open_by_handle_at open_memstream"
    " open_tree open_wmemstream openat opendir openlog optarg opterr optind option optopt osockaddr passwd"
    " pathconf pause pclose perror pid_t pipe pipe2 pkey_alloc pkey_free pkey_get pkey_mprotect pkey_set poll"
    " pollfd popen postorder pow ppoll pread preadv preadv2 preadv64v2 preorder printf prlimit process_madvise"
    " process_mrelease process_vm_readv process_vm_writev profil program_invocation_name"
    " program_invocation_short_name protoent pselect psiginfo psignal ptrdiff_t ptsname putc putchar putenv"
    " putgrent putpwent puts pututxline putw putwc putwchar pvalloc pwrite pwritev pwritev2 pwritev64v2 qecvt"
    " qelem qfcvt qgcvt qsort quad_t quick_exit raise rand random random_data rawmemchr rcmd rcmd_af"
    " re_compile_fastmap re_compile_pattern re_dfa_t re_match re_match_2 re_pattern_buffer re_registers"
    " re_search re_search_2 re_set_registers re_set_syntax re_syntax_options read readahead readdir readdir64_r"
    " readlink readlinkat readv realloc reallocarray realpath recv recvfrom recvmmsg recvmsg reg_errcode_t"
    " reg_syntax_t regcomp regerror regex_t regexec regfree register_t regmatch_t regoff_t remap_file_pages"
    " remove remque rename renameat renameat2 revoke rewind rewinddir rexec rexec_af rindex rlim64_t rlim_t"
    " rlimit rmdir rpcent rpmatch rresvport rresvport_af rusage ruserok ruserok_af s_reg_t sa_family_t sbrk"
    " scandir scandirat scanf secure_getenv seed48 seekdir select sembuf semctl semget semid_ds seminfo semop"
    " semtimedop send sendmmsg sendmsg sendto servent setbuf setbuffer setdomainname setegid setenv seteuid"
    " setgid setgrent setgroups sethostent sethostid sethostname setipv4sourcefilter setitimer setlinebuf"
    " setlocale setlogin setlogmask setnetent setnetgrent setns setpayload setpayloadsig setpgid setpgrp"
    " setpriority setprotoent setpwent setregid setresgid setresuid setreuid setrlimit setrpcent setservent"
    " setsid setsockopt setsourcefilter setstate settimeofday setuid setusershell setutxent setvbuf shm_info"
    " shm_open shm_unlink shmat shmatt_t shmctl shmdt shmget shmid_ds shminfo shutdown sig_atomic_t sig_t"
    " sigabbrev_np sigaction sigaddset sigaltstack sigandset sigblock sigcontext sigdelset sigdescr_np"
    " sigemptyset sigevent sigevent_t sigfillset siggetmask sighandler_t sighold sigignore siginfo_t"
    " siginterrupt sigisemptyset sigismember sigjmp_buf siglongjmp signal signgam significand sigorset sigpause"
    " sigpending sigprocmask sigqueue sigrelse sigreturn sigset sigset_t sigsetmask sigstack sigsuspend"
    " sigtimedwait sigval sigval_t sigwait sigwaitinfo sin sincos sinh size_t sleep snprintf sockaddr"
    " sockaddr_in sockaddr_in6 sockaddr_storage sockaddr_un sockatmark socket socketpair socklen_t speed_t"
    " splice sprintf sqrt srand srand48 srandom sscanf ssignal ssize_t stack_t stat statvfs statx"
    " statx_timestamp stpcpy stpncpy strcasecmp strcasestr strcat strchr strchrnul strcmp strcoll strcpy strcspn"
    " strdup strerror strerrordesc_np strerrorname_np strfmon strfromd strfromf strfromf128 strfromf32"
    " strfromf32x strfromf64x strfroml strfry strftime strlen strncasecmp strncat strncmp strncpy strndup"
    " strnlen strpbrk strptime strrchr strsep strsignal strspn strstr strtod strtof strtof128 strtof32 strtof32x"
    " strtof64_l strtof64x strtoimax strtok strtol strtold strtoll_l strtoq strtoul strtoull_l strtoumax strtouq"
    " strverscmp strxfrm suseconds_t swab swprintf swscanf symlink symlinkat sync sync_file_range syncfs syscall"
    " sysconf sysinfo syslog system sysv_signal tan tanh tcdrain tcflag_t tcflow tcflush tcgetattr tcgetpgrp"
    " tcgetsid tcp_ca_state tcp_cookie_transactions tcp_info tcp_md5sig tcp_repair_opt tcp_repair_window tcp_seq"
    " tcp_zerocopy_receive tcphdr tcsendbreak tcsetattr tcsetpgrp tdelete tdestroy tee telldir tempnam termio"
    " termios textdomain tfind tgkill time time_t timegm timelocal timer_create timer_delete timer_getoverrun"
    " timer_gettime timer_settime timer_t times timespec timespec_get timespec_getres timeval timex timezone tm"
    " tmpfile tmpnam tms tolower totalorder totalordermag toupper towctrans towlower towupper truncate tsearch"
    " ttyname ttyslot twalk tzname tzset u_char u_int u_int16_t u_int32_t u_int64_t u_int8_t u_long u_quad_t"
    " u_short ualarm ucontext_t ucred uid_t uint uint16_t uint32_t uint64_t uint8_t uint_fast16_t uint_fast32_t"
    " uint_fast64_t uint_fast8_t uint_least16_t uint_least32_t uint_least64_t uint_least8_t uintmax_t uintptr_t"
    " ulimit ulong umask umount umount2 uname ungetc ungetwc unlink unlinkat unlockpt unsetenv unshare updwtmpx"
    " useconds_t uselocale ushort usleep utimbuf utime utimensat utimes utmp utmpx utmpxname utsname va_list"
    " valloc vasprintf vdprintf verr verrx versionsort vfork vfprintf vfscanf vfwprintf vfwscanf vhangup"
    " vmsplice vprintf vscanf vsnprintf vsprintf vsscanf vswprintf vswscanf vsyslog vwarn vwarnx vwprintf"
    " vwscanf wait wait3 wait4 waitid waitpid warn warnx wcpcpy wcpncpy wcrtomb wctob wctomb wctrans wctrans_t"
    " wctype wctype_t wcwidth winsize wint_t wordexp wordexp_t wordfree wprintf write writev wscanf y0 y1 yn"
    " ";
// clang-format on

bool is_listed(std::string_view word) {
    return names.find(" " + std::string(word) + " ") != std::string_view::npos;
}

}  // namespace

bool is_global_in_c(std::string_view name) {
    constexpr std::string_view begins[] = {"pthread_", "posix_",   "sched_", "sem_",   "mq_",
                                           "aio_",     "lio_",     "inet_",  "inet6_", "epoll_",
                                           "eventfd",  "timerfd_", "wcs",    "wmem",   "iconv_"};
    // Of other types of numbers (sinf, sinf32), for files of 64 bits, and with a locale.
    constexpr std::string_view ends[] = {"f",         "l",      "f32",   "f32x",   "f64",   "f64x", "f128",
                                         "_unlocked", "_l",     "_r",    "64",     "ll",    "f_l",  "ll_l",
                                         "f32_l",     "f32x_l", "f64_l", "f64x_l", "f128_l"};
    constexpr std::size_t of_macros = 7;  // the first of them, which follow names of functions that are macros too
    if (is_listed(name)) return true;
    if (std::any_of(std::begin(begins), std::end(begins),
                    [&](std::string_view one) { return name.starts_with(one); }))
        return true;
    for (std::size_t k = 0; k < std::size(ends); ++k) {
        if (!name.ends_with(ends[k])) continue;
        const std::string_view before = name.substr(0, name.size() - ends[k].size());
        if (is_listed(before) || (k < of_macros && may_be_macro(before))) return true;
    }
    return false;
}

}  // namespace alembert
