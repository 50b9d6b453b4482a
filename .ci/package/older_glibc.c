/* What the module and the libraries inside it use of glibc 2.29 to 2.35, written with what glibc 2.28 has, so that the
   module runs where Blender itself does, whatever glibc it is linked with. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <time.h>

/* Functions that 2.28 has too, in another version: the linker sends every call of NAME to __wrap_NAME, for which
   CMakeLists.txt reads the names here. */
#define OLD(name, version, result, parameters, arguments) \
  result old_##name parameters;                           \
  __asm__(".symver old_" #name "," #name "@" version);    \
  result __wrap_##name parameters { return old_##name arguments; }

OLD(exp, "GLIBC_2.2.5", double, (double x), (x))
OLD(hypot, "GLIBC_2.2.5", double, (double x, double y), (x, y))
OLD(log, "GLIBC_2.2.5", double, (double x), (x))
OLD(pow, "GLIBC_2.2.5", double, (double x, double y), (x, y))
OLD(__pthread_key_create, "GLIBC_2.2.5", int, (pthread_key_t* key, void (*end)(void*)), (key, end))
OLD(pthread_key_create, "GLIBC_2.2.5", int, (pthread_key_t* key, void (*end)(void*)), (key, end))
OLD(pthread_key_delete, "GLIBC_2.2.5", int, (pthread_key_t key), (key))
OLD(pthread_getspecific, "GLIBC_2.2.5", void*, (pthread_key_t key), (key))
OLD(pthread_setspecific, "GLIBC_2.2.5", int, (pthread_key_t key, const void* value), (key, value))
OLD(pthread_once, "GLIBC_2.2.5", int, (pthread_once_t* once, void (*run)(void)), (once, run))
OLD(pthread_create, "GLIBC_2.2.5", int,
    (pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* data),
    (thread, attributes, run, data))
OLD(pthread_join, "GLIBC_2.2.5", int, (pthread_t thread, void** result), (thread, result))
OLD(pthread_getaffinity_np, "GLIBC_2.3.4", int, (pthread_t thread, size_t size, cpu_set_t* set), (thread, size, set))
OLD(pthread_setaffinity_np, "GLIBC_2.3.4", int, (pthread_t thread, size_t size, const cpu_set_t* set),
    (thread, size, set))

/* 2.32: libstdc++ counts references without atomic operations where this is set. */
char __libc_single_threaded = 0;

/* 2.30: waits until a time of the clock that libstdc++ chooses; here by the time of day, which is all that 2.28 has. */
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* until) {
  struct timespec here, day;
  clock_gettime(clock, &here);
  clock_gettime(CLOCK_REALTIME, &day);
  const long second = 1000000000L;
  const long long wait = (until->tv_sec - here.tv_sec) * (long long)second + until->tv_nsec - here.tv_nsec;
  const long long end = day.tv_sec * (long long)second + day.tv_nsec + (wait > 0 ? wait : 0);
  day.tv_sec = end / second;
  day.tv_nsec = end % second;
  return pthread_cond_timedwait(condition, mutex, &day);
}

struct search {
  ElfW(Addr) address;
  struct dl_find_object* found;
};

static int look_into(struct dl_phdr_info* object, size_t size, void* data) {
  (void)size;
  const struct search* search = data;
  ElfW(Addr) begin = ~(ElfW(Addr))0, end = 0, frames = 0;
  int inside = 0;
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)* part = object->dlpi_phdr + k;
    const ElfW(Addr) first = object->dlpi_addr + part->p_vaddr, last = first + part->p_memsz;
    if (part->p_type == PT_GNU_EH_FRAME) frames = first;
    if (part->p_type != PT_LOAD) continue;
    if (first < begin) begin = first;
    if (last > end) end = last;
    if (search->address >= first && search->address < last) inside = 1;
  }
  if (!inside || frames == 0) return 0;
  search->found->dlfo_map_start = (void*)begin;
  search->found->dlfo_map_end = (void*)end;
  search->found->dlfo_eh_frame = (void*)frames;
  return 1;
}

/* 2.35: libgcc asks where the table for exceptions is of the code at an address. */
int _dl_find_object(void* address, struct dl_find_object* result) {
  const struct search search = {(ElfW(Addr))address, result};
  return dl_iterate_phdr(look_into, (void*)&search) == 1 ? 0 : -1;
}
