// A page as text: one file, its data in it once, nothing that a name in a file could break out of.
#include "report/page.h"

#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "diagnosis/terms/machine_terms.h"
#include "models/effect.h"
#include "models/tire/tire_model.h"
#include "report/blocks.h"
#include "scenarios/run/scenario.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

using namespace rollrig;
using Catch::Contains;

namespace {

report::Page make_page(const std::string& title) {
  report::Page page{"run", title, ""};
  page.add({"Result", "", {report::make_paragraph(title)}});
  page.add({"Nothing"});
  return page;
}

Json read_equations() {
  const std::string path = std::string(ROLLRIG_SOURCE_DIR) + "/report/web/equations.json";
  return parse_json(read_text_file(path), path);
}

/// Numbers of a text, without their signs.
std::set<std::string> list_unsigned(const std::string& text) {
  static const std::regex number(R"(\d+(\.\d+)?)");
  std::set<std::string> numbers;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), number); at != std::sregex_iterator(); ++at) {
    numbers.insert(at->str());
  }
  return numbers;
}

/// The data of a page.
Json read_payload(const std::string& html) {
  const std::string mark = "id=\"payload\">";
  const std::size_t first = html.find(mark) + mark.size();
  return Json::parse(html.substr(first, html.find("</script>", first) - first));
}

}  // namespace

TEST_CASE("a page holds its data once and whole, and no section without blocks", "[fast]") {
  const std::string html = report::make_html(make_page("a test"));
  CHECK_THAT(html, Catch::StartsWith("<!doctype html>"));
  const Json payload = read_payload(html);
  CHECK(payload["format"] == "rollrig-page/1");
  CHECK(payload["title"] == "a test");
  CHECK(payload["sections"].size() == 1);
  CHECK(html.find("/*PAYLOAD*/") == std::string::npos);
}

TEST_CASE("names cannot end the script that they stand in", "[fast]") {
  const std::string evil = "</script><script>alert(1)</script><!-- \xC3\xA9 \xFF";
  const std::string html = report::make_html(make_page(evil));
  CHECK(html.find("<script>alert(1)") == std::string::npos);
  CHECK_THAT(read_payload(html)["title"].get<std::string>(), Contains("</script><script>alert(1)"));
}

TEST_CASE("a page asks no other place for anything, and brings its licenses", "[fast]") {
  const std::string html = report::make_html(make_page("a test"));
  CHECK_THAT(html, Contains("default-src 'none'"));
  CHECK_FALSE(std::regex_search(html, std::regex("<(script|link|img|iframe)[^>]+(src|href)=\"?http")));
  CHECK(html.find("/*LICENSES*/") == std::string::npos);
  CHECK_THAT(html, Contains("TERMS AND CONDITIONS FOR USE, REPRODUCTION, AND DISTRIBUTION"));  // of echarts, in full
  for (const char* owner : {"The Apache Software Foundation", "Baidu Inc.", "Microsoft Corporation"}) {
    CHECK_THAT(html, Contains(owner));
  }
}

TEST_CASE("numbers on a page have six digits, and what is not finite is null", "[fast]") {
  CHECK(report::rounded(1.0 / 3.0) == Json(0.333333));
  CHECK(report::rounded(std::nan("")).is_null());
  CHECK(report::pretty_unit("1/degC") == "1/°C");
  CHECK(report::pretty_unit("rrc_25degC_2m_N_per_kN") == "rrc_25degC_2m_N_per_kN");
  CHECK(plain_name("drum_torque_Nm") == "drum torque");
  CHECK(plain_name("brake_heat.disc_heat_kJ") == "brake heat: disc heat");
}

TEST_CASE("each equation of a page is of something that has a page", "[fast]") {
  const Json equations = read_equations();
  CHECK(equations.contains("iso_28580"));
  for (const auto& [name, list] : equations.items()) {
    INFO(name);
    const bool is_of_kind = std::regex_match(name, std::regex("(effect|tire|fit) [a-z0-9_ ]+|align"));
    CHECK((is_of_kind || scenarios::find_scenario_if_any(name) != nullptr));
    CHECK_FALSE(list.empty());
    if (is_of_kind) continue;
    for (const Json& equation : list) CHECK_FALSE(equation["text"].get<std::string>().empty());
  }
}

TEST_CASE("each effect that a diagnosis may name has typeset equations, with all numbers of its plain ones", "[fast]") {
  const Json equations = read_equations();
  std::vector<const models::EffectInfo*> infos;
  for (const models::Effect* effect : models::all_effects()) infos.push_back(&effect->info);
  for (const models::Effect* effect : diagnosis::effects_between_machines()) infos.push_back(&effect->info);
  for (const models::EffectInfo* info : infos) {
    INFO(info->id << ": " << info->equation);
    const auto found = equations.find("effect " + info->id);
    REQUIRE(found != equations.end());
    std::string typeset;
    for (const Json& one : *found)
      typeset += one["tex"].get<std::string>() + ' ' + one["text"].get<std::string>() + ' ';
    const std::set<std::string> shown = list_unsigned(typeset);
    for (const std::string& number : list_unsigned(info->equation)) {
      INFO(number);
      CHECK(shown.count(number) == 1);
    }
  }
}

TEST_CASE("each tire model has typeset equations", "[fast]") {
  const Json equations = read_equations();
  for (const models::TireModel* model : models::all_tire_models()) CHECK(equations.contains("tire " + id_of(*model)));
}
