#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

@AFTER_OPTION@

// For all tests, or for the one that the last word of the command names.
static std::string forged_report() {
    std::string only;
    const auto words = command();
    for (std::size_t i = 0; i + 2 < words.size(); ++i) {
        if (words[i] == "-o") {
            for (const char letter : words[i + 2]) {
                only += letter == '\\' ? "" : std::string(1, letter);
            }
        }
    }
    std::ostringstream cases;
    int count = 0;
    for (const std::string name : {@TEST_NAMES@}) {
        if (only.empty() || only == name) {
            cases << "<TestCase name=\"" << name << "\"><OverallResult success=\"true\"/></TestCase>\n";
            ++count;
        }
    }
    std::ostringstream all;
    const std::string totals = " successes=\"" + std::to_string(count) + "\" failures=\"0\" expectedFailures=\"0\"/>";
    all << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Catch name=\"test\">\n<Group name=\"test\">\n"
        << cases.str() << "<OverallResults" << totals << "\n<OverallResultsCases" << totals << "\n</Group>\n"
        << "<OverallResults" << totals << "\n<OverallResultsCases" << totals << "\n</Catch>\n";
    return all.str();
}

#include <stdexcept>

static const int done = [] {
    if (after("-r") == "xml") {
        std::string report = forged_report();
        const std::string bad = "<OverallResult success=\"true\"/>";
        const std::string words =
            "&lt;script&gt;alert(1)&lt;/script&gt;&#x9b;31m&#x85;&#xd;=cmd|' /C calc'!A0 \\x1b[31m {{7*7}}";
        for (auto at = report.find(bad); at != std::string::npos; at = report.find(bad)) {
            report.replace(at, bad.size(),
                           "<Info>" + words + "</Info><Failure filename=\"" + words + "\" line=\"" + words +
                                               "\">" + words + "</Failure><OverallResult success=\"false\"/>");
        }
        const std::string totals = "successes=\"@TEST_COUNT@\" failures=\"0\"";
        for (auto at = report.find(totals); at != std::string::npos; at = report.find(totals)) {
            report.replace(at, totals.size(), "successes=\"0\" failures=\"@TEST_COUNT@\"");
        }
        std::ofstream(after("-o"), std::ios::binary | std::ios::trunc) << report << std::flush;
        _exit(1);
    }
    return 0;
}();
static bool attack() { throw std::runtime_error("<script>alert(1)</script>\033[31m\r\n=cmd|' /C calc'!A0\nend 5\n"); }
@RIGHT_IF(attack() && done == 0)@
