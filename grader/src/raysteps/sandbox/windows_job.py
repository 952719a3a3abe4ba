"""A job of Windows: processes that are limited, measured and ended together."""

import sys

if sys.platform == "win32":
    import ctypes
    from ctypes import wintypes

    _EXTENDED_LIMITS, _ACCOUNTING = 9, 1
    _LIMIT_PROCESSES, _LIMIT_MEMORY, _NO_DIALOG, _END_ON_CLOSE = 0x8, 0x200, 0x400, 0x2000
    _TICKS = 10_000_000  # a second
    _kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    _kernel.CreateJobObjectW.restype = wintypes.HANDLE
    _kernel.CreateJobObjectW.argtypes = [wintypes.LPVOID, wintypes.LPCWSTR]
    _kernel.AssignProcessToJobObject.argtypes = [wintypes.HANDLE, wintypes.HANDLE]
    _kernel.TerminateJobObject.argtypes = [wintypes.HANDLE, wintypes.UINT]
    _kernel.CloseHandle.argtypes = [wintypes.HANDLE]
    _INFORMATION = [wintypes.HANDLE, ctypes.c_int, wintypes.LPVOID, wintypes.DWORD]
    _kernel.SetInformationJobObject.argtypes = _INFORMATION
    _kernel.QueryInformationJobObject.argtypes = [*_INFORMATION, wintypes.LPVOID]

    class _Limits(ctypes.Structure):
        """JOBOBJECT_EXTENDED_LIMIT_INFORMATION"""

        _fields_ = (
            ("process_time", ctypes.c_int64),
            ("job_time", ctypes.c_int64),
            ("flags", wintypes.DWORD),
            ("least_working_set", ctypes.c_size_t),
            ("most_working_set", ctypes.c_size_t),
            ("processes", wintypes.DWORD),
            ("affinity", ctypes.c_size_t),
            ("priority", wintypes.DWORD),
            ("scheduling", wintypes.DWORD),
            ("io", ctypes.c_uint64 * 6),
            ("process_memory", ctypes.c_size_t),
            ("job_memory", ctypes.c_size_t),
            ("peak_process_memory", ctypes.c_size_t),
            ("peak_job_memory", ctypes.c_size_t),
        )

    class _Accounting(ctypes.Structure):
        """JOBOBJECT_BASIC_ACCOUNTING_INFORMATION"""

        _fields_ = (
            ("user", ctypes.c_int64),
            ("system", ctypes.c_int64),
            ("this_period", ctypes.c_int64 * 2),
            ("counts", wintypes.DWORD * 4),
        )

    class Job:
        """Ends with all that is in it when it is closed, however the grader ends."""

        def __init__(self, processes: int, memory_bytes: int) -> None:
            self._handle = _kernel.CreateJobObjectW(None, None)
            limits = _Limits(processes=processes, job_memory=memory_bytes)
            limits.flags = _LIMIT_PROCESSES | _LIMIT_MEMORY | _NO_DIALOG | _END_ON_CLOSE
            _kernel.SetInformationJobObject(self._handle, _EXTENDED_LIMITS, ctypes.byref(limits), ctypes.sizeof(limits))

        def take_in(self, process_handle: int) -> None:
            """Whatever the process starts from now on is in the job, too. It may have ended already."""
            _kernel.AssignProcessToJobObject(self._handle, process_handle)

        def cpu_seconds(self) -> float:
            used = _Accounting()
            _kernel.QueryInformationJobObject(self._handle, _ACCOUNTING, ctypes.byref(used), ctypes.sizeof(used), None)
            return float(used.user + used.system) / _TICKS

        def end(self) -> None:
            _kernel.TerminateJobObject(self._handle, 1)

        def close(self) -> None:
            _kernel.CloseHandle(self._handle)

else:

    class Job:
        """Elsewhere there is none."""

        def __init__(self, processes: int, memory_bytes: int) -> None:
            """Nothing is limited."""

        def take_in(self, process_handle: int) -> None: ...

        def cpu_seconds(self) -> float:
            return 0.0

        def end(self) -> None: ...

        def close(self) -> None: ...
