"""What is installed: files, the shared library and what it shows, the command's manual and completion."""

import re
import shutil
import unittest

from outside import BUILD, OutsideTest, SOURCE, run

# What the linker adds by itself.
LINKER_NAMES = {"_init", "_fini", "_edata", "_end", "__bss_start"}
# Functions and classes of filigree, their virtual tables and type information; and the C API.
SHOWN = re.compile(r"(filigree_|_ZNK?8filigree|_ZT[VISC]N8filigree)\w*")


class Installed(OutsideTest):
    def setUp(self):
        super().setUp()
        self.prefix = self.install()

    def find(self, pattern):
        found = sorted(self.prefix.glob(pattern))
        self.assertTrue(found, f"{pattern} is not installed")
        return found[0]

    def environment(self):
        return {"PATH": "/usr/bin:/bin", "PKG_CONFIG_PATH": str(self.find("lib/**/pkgconfig")),
                "LD_LIBRARY_PATH": str(self.find("lib/**/libfiligree.so").parent)}

    def test_headers(self):
        headers = {str(path.relative_to(self.prefix / "include")) for path in (self.prefix / "include").rglob("*.h")}
        ours = {str(path.relative_to(SOURCE / "include")) for path in (SOURCE / "include").rglob("*.h")}
        left_out = {name for name in ours if name.startswith(("filigree/jobs/", "filigree/report/"))}
        self.assertEqual(headers, ours - left_out)

    def test_the_shared_library_shows_filigree_alone(self):
        library = self.find("lib/**/libfiligree.so.0")
        names = [line.split()[-1] for line in self.expect_done("nm", "-D", "--defined-only", library).splitlines()]
        self.assertIn("filigree_version", names)
        foreign = [name for name in names if not SHOWN.fullmatch(name) and name not in LINKER_NAMES]
        self.assertEqual(foreign, [])
        self.assertIn("[libfiligree.so.0]", self.expect_done("readelf", "-d", library))

    def test_pkg_config(self):
        flags = self.expect_done("pkg-config", "--cflags", "--libs", "filigree", env=self.environment()).split()
        program = self.folder / "version"
        source = self.folder / "version.c"
        source.write_text("#include <filigree.h>\n#include <stdio.h>\n"
                          'int main(void) { printf("%u\\n", (unsigned)filigree_version()); return 0; }\n')
        self.expect_done("cc", source, "-o", program, *flags)
        self.assertEqual(self.expect_done(program, env=self.environment()), "100\n")
        self.assertEqual(self.expect_done("pkg-config", "--modversion", "filigree", env=self.environment()), "0.1.0\n")

    def test_find_package(self):
        uses = self.project("uses", """
find_package(filigree 0.1 REQUIRED COMPONENTS shared c io trace lookup)
foreach(target shared c io trace grid bvh core lookup)
    if(NOT TARGET filigree::${target})
        message(FATAL_ERROR "no target ${target}")
    endif()
endforeach()
file(WRITE c.c "#include <filigree.h>\\nint main(void) { return filigree_version() != 100; }")
file(COPY_FILE ${EXAMPLES}/bake/main.cpp shared.cpp)
add_executable(from_c c.c)
target_link_libraries(from_c PRIVATE filigree::shared)
add_executable(from_c_static c.c)
set_target_properties(from_c_static PROPERTIES LINKER_LANGUAGE CXX)
target_link_libraries(from_c_static PRIVATE filigree::c)
add_executable(from_cpp shared.cpp)
target_link_libraries(from_cpp PRIVATE filigree::shared)
""")
        self.expect_configured(uses, "use", f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DEXAMPLES={SOURCE / 'examples'}")
        self.expect_done("cmake", "--build", self.folder / "use")
        for program in ("from_c", "from_c_static"):
            self.expect_done(self.folder / "use" / program)
        self.assertEqual(self.expect_done(self.folder / "use" / "from_cpp"),
                         (SOURCE / "examples" / "bake" / "expected.txt").read_text())

    def test_what_is_missing_is_named(self):
        for components, says in (("COMPONENTS bake sing", "component sing: not in this installation, which has: lookup core"),
                                 ("", "find_package(filigree) needs COMPONENTS")):
            with self.subTest(components):
                name = f"missing{len(components)}"
                wants = self.project(name, f"find_package(filigree REQUIRED {components})\n")
                done = self.configure(wants, f"{name}-build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(says, " ".join(done.stdout.split()))
        wants = self.project("hidden", "find_package(filigree REQUIRED COMPONENTS trace)\n")
        done = self.configure(wants, "hidden-build", f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_DISABLE_FIND_PACKAGE_embree=ON")
        self.assertIn("component trace: embree was not found (libembree-dev in Debian)", " ".join(done.stdout.split()))

    def test_the_manual_has_every_verb_and_option(self):
        page = self.find("share/man/man1/filigree.1")
        text = re.sub(r"\\f[BIR]", "", page.read_text()).replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")
        command = self.prefix / "bin" / "filigree"
        for verb in re.findall(r"^  ([a-z]+) ", self.expect_done(command, "--help").split("Subcommands:")[1], re.M):
            self.assertIn(f".SS {verb}\n", text)
            for option in re.findall(r"--[a-z][a-z-]+", self.expect_done(command, verb, "--help")):
                if option != "--help":
                    self.assertIn(option, text)

    @unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "no tools for Debian packages")
    def test_debian_packages_run_from_a_clean_root(self):
        self.expect_done("cpack", "-G", "DEB", "-B", self.folder / "deb", "--config", BUILD / "CPackConfig.cmake", cwd=self.folder)
        root = self.folder / "root"
        depends = {}
        for package in sorted((self.folder / "deb").glob("*.deb")):
            self.expect_done("dpkg-deb", "-x", package, root)
            depends[package.name.split("_")[0]] = self.expect_done("dpkg-deb", "-f", package, "Depends")
        self.assertEqual(sorted(depends), ["filigree", "libfiligree", "libfiligree-dev"])
        for name, wants in (("filigree", "libembree3-3"), ("libfiligree", "libstdc++6"), ("libfiligree-dev", "libfiligree (= 0.1.0)"),
                            ("libfiligree-dev", "libembree-dev")):
            self.assertIn(wants, depends[name])
        command = root / "usr/bin/filigree"
        self.assertEqual(self.expect_done(command, "--version"), "filigree 0.1.0\n")
        self.assertNotIn("not found", self.expect_done("ldd", next(root.glob("usr/lib/**/libfiligree.so.0.1.0"))))

    def complete(self, *words):
        script = self.find("share/bash-completion/completions/filigree")
        asks = f'. {script}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _filigree; echo "${{COMPREPLY[*]}}"'
        return self.expect_done("bash", "-c", asks, "bash", self.prefix / "bin" / "filigree", *words).split()

    def test_completion(self):
        self.assertEqual(self.complete("ba"), ["bake"])
        self.assertIn("compress", self.complete(""))
        self.assertEqual(self.complete("bench", "lo"), ["lookup"])
        self.assertIn("--rounds", self.complete("bench", "trace", "--"))
        self.assertEqual(self.complete("bake", "in.glb", "--max-l"), ["--max-level"])
        self.assertEqual(self.complete("bake", "in"), [])


if __name__ == "__main__":
    unittest.main()
