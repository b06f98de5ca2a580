"""The modules that flake8-import-order before 0.19 counts as the standard library.

It includes modules of all Python versions up to about 3.8, and lacks the newest ones (``tomllib``,
``graphlib``), so ``sys.stdlib_module_names`` would give other findings. The list was obtained by
running it on every module of Python 2.7 and 3.6 to 3.13.
"""

from __future__ import annotations

_NAMES = """
    BaseHTTPServer Bastion CGIHTTPServer ColorPicker ConfigParser Cookie DocXMLRPCServer
    EasyDialogs FrameWork HTMLParser MacOS MimeWriter Queue SUNAUDIODEV SimpleHTTPServer
    SimpleXMLRPCServer SocketServer StringIO Tix Tkinter UserDict UserList UserString
    __builtin__ __future__ __main__ _dummy_thread _thread _threading_local _winapi abc aepack
    aetools aifc al anydbm argparse array ast asynchat asyncio asyncore atexit audioop autoGIL
    base64 bdb binascii binhex bisect bsddb builtins bz2 cPickle cProfile cStringIO calendar cd
    cgi cgitb chunk cmath cmd code codecs codeop collections colorsys commands compileall
    concurrent configparser contextlib contextvars cookielib copy copy_reg copyreg crypt csv
    ctypes curses dataclasses datetime dbhash dbm decimal difflib dircache dis distutils dl
    doctest dumbdbm dummy_thread dummy_threading email encodings ensurepip enum errno
    faulthandler fcntl filecmp fileinput findertools fl fm fnmatch formatter fpformat fractions
    ftplib functools future_builtins gc gdbm gensuitemodule getopt getpass gettext gl glob grp
    gzip hashlib heapq hmac hotshot html htmlentitydefs htmllib http httplib ic imaplib imgfile
    imghdr imp importlib imputil inspect io ipaddress itertools jpeg json keyword lib2to3
    linecache locale logging lzma macostools macpath macurl2path mailbox mailcap marshal math
    md5 mhlib mimetools mimetypes mimify mmap modulefinder msilib multifile multiprocessing
    mutex netrc new nis nntplib ntpath nturl2path numbers operator optparse os os2emxpath
    ossaudiodev parser pathlib pdb pickle pickletools pipes pkgutil platform plistlib popen2
    poplib posix posixfile posixpath pprint profile pstats pty pwd py_compile pyclbr pydoc
    pyexpat queue quopri random re readline repr reprlib resource rexec rfc822 rlcompleter
    robotparser runpy sched secrets select selectors sets sgmllib sha shelve shlex shutil signal
    site smtpd smtplib sndhdr socket socketserver spwd sqlite3 ssl stat statistics statvfs
    string stringprep struct subprocess sunau sunaudiodev symbol symtable sys sysconfig syslog
    tabnanny tarfile telnetlib tempfile termios test textwrap thread threading time timeit
    tkinter token tokenize trace traceback tracemalloc tty turtle turtledemo types typing
    unicodedata unittest urllib urllib2 urlparse user uu uuid venv warnings wave weakref
    webbrowser whichdb winsound wsgiref xdrlib xml xmlrpc xmlrpclib zipapp zipfile zipimport
    zlib zoneinfo
"""

STDLIB = frozenset(_NAMES.split())
