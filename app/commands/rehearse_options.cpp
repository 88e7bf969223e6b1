#include "app/commands/rehearse_options.h"

#include "app/case/caries_lesion.h"
#include "app/case/case.h"
#include "app/case/patient_placement.h"
#include "app/controls/control.h"
#include "app/device/pose_source_table.h"
#include "app/device/second_hand.h"
#include "app/options/feel_preset.h"
#include "app/options/law_text.h"
#include "app/options/pedal_option.h"
#include "app/options/tool_text.h"
#include "app/procedure/preparation/ideal_rule.h"
#include "app/procedure/steps/step_file.h"
#include "app/station/patient_list.h"
#include "app/text/list.h"
#include "assets/instrument/second_instrument.h"
#include "haptics/device/thread_priority.h"
#include "render/quality_ladder.h"

namespace app {

void addRehearseOptions(CommandLine& command, RehearseOptions& options) {
  command.optionGroup("Patient");
  Option patient = command.option("PATIENT", options.patient, std::string(kPatientHelp) + " [the built-in patient]");
  command.flag("--cases", options.list_cases,
               "List the named cases of the built-in patient, the practice blocks and the imported patients, and end");
  Option named = command.option("--case", options.case_name,
                                "Built-in patient: a case, or a practice block, by its name, see --cases");
  named.oneOf(rehearsalNames()).excludes(patient);
  const auto built_in = [&](const std::string& name, auto& value, const std::string& help) {
    return command.option(name, value, "Built-in patient: " + help).showsDefault().excludes(patient);
  };
  built_in("--side", options.side, "side of the tooth").oneOf({"right", "left"}).excludes(named);
  built_in(
      "--winter-angle", options.jaw.winter_angle_deg,
      "tilt of the tooth after Winter, degrees: vertical 0, mesio-angular 45, horizontal 90, disto-angular below 0")
      .from(-79.0, 100.0)
      .excludes(named);
  built_in("--depth", options.jaw.depth_mm,
           "top of the crown below the occlusal plane, mm (Pell and Gregory: A about 0, B about 4, C about 8)")
      .from(0.0, 12.0)
      .excludes(named);
  built_in("--canal-distance", options.jaw.mandibular_canal_distance_mm, "root to mandibular canal, mm; 0 touches it")
      .from(0.0, 6.0)
      .excludes(named);
  built_in("--voxel", options.jaw.spacing_mm, "voxel edge, mm").from(0.15, 1.0);
  built_in("--seed", options.jaw.seed, "number that varies its shape");
  Option task = command.option("--task", options.task,
                               "extraction; or root-canal: one tooth, its canals, burs for the access and K-files; or "
                               "preparation: one tooth is prepared for a crown or a filling");
  task.oneOf({"extraction", "root-canal", "preparation"}).showsDefault();
  command
      .option(
          "--ideal", options.ideal,
          "Of a preparation, what it is measured against: " +
              joined(idealRules(), [](const IdealRule& rule) { return std::string(rule.name); }) +
              "; or FILE.nrrd, solid fraction or 0 and 1; or FILE.stl, the closed surface of the prepared tooth; both "
              "where the patient's tooth stands, mm [crown:all-ceramic; with --caries the cavity over it]")
      .valueNamed("NAME|FILE")
      .needs(task);
  command
      .option("--caries", options.caries,
              "Of a preparation: a carious lesion there, soft inside and firm around, to be excavated")
      .oneOf(cariesSites())
      .needs(task);
  Option cavity = command.option(
      "--cavity", options.cavity,
      "Of a preparation for a filling: uncut; or ready: it is cut to its ideal, to practise filling it. Space, "
      "pedal or button lays, packs, carves and cures");
  cavity.oneOf({"uncut", "ready"}).showsDefault().needs(task);
  command
      .option("--paper-um", options.paper_um,
              "Of a preparation: articulating paper, its thickness in µm (real ones: 8 to 200)")
      .from(kLeastPaper_um, kMostPaper_um)
      .showsDefault()
      .needs(task);
  command
      .option("--antagonist", options.antagonist,
              "Of a preparation: the opposing teeth, FILE.stl, closed or open, where the teeth meet in the patient's "
              "frame, mm [those of the scan where it has both jaws, else made from the tooth]")
      .valueNamed("FILE")
      .needs(task);
  command
      .option("--bite", options.bite,
              "Of a preparation, how the jaws close on paper: axis, along the tooth; hinge, about the condyles; "
              "balance, until three contacts around its middle hold what opposes it [hinge on a whole arch, else axis]")
      .oneOf({"axis", "hinge", "balance"})
      .needs(task);
  command
      .option("--hinge", options.hinge,
              "BACK,UP: how far the axis of the condyles lies behind the tooth and over its bite, mm [of a mean jaw: "
              "55,32 for a first molar]")
      .needs(task);
  command
      .option("--tooth", options.tooth,
              "The tooth of a root-canal treatment or a preparation, FDI number, see molar teeth")
      .wholeFrom(11, 48)
      .needs(task);
  command.option("--access", options.access, "closed: the crown is whole; open: the access cavity is cut, files go in")
      .oneOf({"closed", "open"})
      .showsDefault()
      .needs(task);
  command
      .option("--apex-locator", options.locator,
              "What it tells of a file's tip: real, with the errors of one; exact; off")
      .oneOf({"real", "exact", "off"})
      .showsDefault()
      .needs(task);
  command
      .option("--wear", options.wear,
              "How files take from a root canal: rate, by force and slip; or, for comparison, the published counters "
              "along the file or along its flutes, without force")
      .oneOf({"rate", "counters", "counters-helical"})
      .showsDefault()
      .needs(task);
  Option face = command.option("--face", options.face, "Face model, glTF; teeth.json beside it places the jaw")
                    .valueNamed("FILE");
  command.option("--opening", options.opening_mm, kOpeningHelp)
      .from(assets::kLeastOpening_mm, assets::kMostOpening_mm)
      .excludes(patient)
      .excludes(face);
  command
      .option("--position", options.position,
              "seated, before the surgeon; or lying, approached from the right (10 o'clock), the left (2 o'clock) or "
              "behind (12 o'clock) [seated, or as the rig states]")
      .oneOf({kPatientPositions.begin(), kPatientPositions.end()});
  command.optionGroup("Hand and instruments");
  command.option("--device", options.plan.device, poseSourceHelp()).showsDefault();
  command
      .option(
          "--tool", options.tools,
          headHelp() + "; or forceps, which the pedal closes on a tooth; or " + elevatorForms() + "; or " +
              handInstrumentForms() + "; or " + fileForm() +
              ". Give several to change between them by key T or pedal; without any, an elevator, forceps, suction, "
              "curette and bone file lie beside the bur where a tooth is to be removed, and what fills it where a "
              "cavity is prepared")
      .repeated()
      .showsDefault();
  command.option("--shaft", options.shaft,
                 std::string(kShaftHelp) + " [a neck of the head's size, up to 2.35 mm thick]");
  command.option("--pedal", options.pedal, kPedalHelp).showsDefault();
  Option second = command.option("--second-hand", options.plan.second_hand.device, kSecondHandHelp);
  command.option("--second-tool", options.second_tool, "Instrument of the second hand")
      .oneOf(assets::secondInstrumentNames())
      .showsDefault()
      .needs(second);
  command.option("--falcon-firmware", options.falcon_firmware, "Novint's firmware for a Falcon").valueNamed("FILE");
  command.optionGroup("Procedure");
  Option procedure =
      command
          .option("--procedure", options.procedure,
                  "Follow it step by step: " + joined(shippedProcedures()) +
                      ", or a teacher's own FILE.toml (app/procedure/steps). third-molar with --device scripted: the "
                      "whole operation is shown, from the gutter (with --flap closed: the incision) to the stitches")
          .valueNamed("NAME");
  command
      .option("--guidance", options.guidance,
              "free: nothing is said; guided: the next step, and what it lacks; assessed: nothing is said, errors and "
              "times are recorded [guided; free where the operation is shown]")
      .oneOf({kGuidances.begin(), kGuidances.end()})
      .needs(procedure);
  command
      .option("--predict", options.predict,
              "What you expect, difficulty=easy|moderate|difficult and minutes: difficulty=moderate,minutes=12 [asked "
              "for in the picture, but for free]")
      .valueNamed("WORDS")
      .needs(procedure);
  command
      .option("--drawn", options.drawn,
              "Begin with the trough's and section's lines that were drawn in this session, or last (keys G, Shift+G)")
      .valueNamed("SESSION");
  command
      .option("--coach", options.coach,
              "Says one thing at a time about how you work: on, off, or a supervisor's own FILE.toml of rules "
              "(app/procedure/coach) [on where a procedure is guided, else off; never in assessment]")
      .valueNamed("RULES");
  command.flag("--assess", options.assess,
               "An assessment: no coach, no clearances in view, no undo, no plan, steps in any order; all is recorded, "
               "and the session says that it was assessed");
  command
      .option(
          "--flap", options.flap,
          "raised: the bone lies bare; closed: the gum is whole, and is cut with scalpel:15, raised with periosteal "
          "and held aside by the assistant (key A)")
      .oneOf({"raised", "closed"})
      .showsDefault();
  command.optionGroup("Workplace and picture");
  Option rig = options.rig.addTo(command, true);
  command
      .option("--loupes", options.loupes,
              "Magnification on a desk (without --rig) [4; of a root canal's microscope: 10]")
      .from(1.0, 20.0)
      .excludes(rig);
  options.display.addTo(command);
  command.option("--monitor", options.monitor, "Monitor, from 1; two windows use the next one as well")
      .wholeFrom(1, 16);
  command.flag("--instructor", options.plan.instructor_window,
               "Open the instructor's window, on the next monitor if any");
  command.flag("--operator", options.plan.instructor_window, "Former name of --instructor").hidden();
  command.option("--size", options.size, "Image size").valueNamed("WxH");
  options.picture.addTo(command);
  command.option("--face-window", options.face_window_mm, "Face cut away around the line of sight, mm")
      .from(0.0, 100.0);
  command
      .option("--quality", options.plan.quality_step, "Hold this quality, 0 best, 6 fastest [by measured frame times]")
      .wholeFrom(0, static_cast<int>(render::kQualitySteps.size()) - 1);
  command.flag("--no-sound", options.no_sound, "Without the sound of handpiece and cut (key S)");
  command.flag("--no-line", options.no_line, "Without the line of text in the picture (key L shows it)");
  command
      .option(
          "--clearance", options.clearance,
          "view: mm to canal, lingual plate, second molar and lingual nerve (modelled) on a ruler beside the site, "
          "where the bur is near; sound: by tones instead; off: blind, they are recorded and not told [view; off where "
          "assessed]")
      .oneOf({"view", "sound", "off"});
  command.optionGroup("Output");
  Option record = command
                      .option("--record", options.record,
                              "Session file to write [a new one in the data folder, see molar sessions]")
                      .valueNamed("FILE");
  command.flag("--no-record", options.no_record, "Record nothing").excludes(record);
  command
      .option("--continue", options.continued,
              "Go on where this session ended: its bone, filling, case and tools. last: the newest; undo begins anew")
      .valueNamed("SESSION")
      .excludes(named)
      .excludes(cavity);
  command.option("--seconds", options.plan.seconds, "End after this time").from(0.1, 86400.0);
  command.option("--snapshot", options.plan.snapshot, "Images at the end: NAME_left.png, NAME_right.png");
  command.option("--first-snapshot", options.plan.first_snapshot, "The same before the first cut");
  command.option("--snapshot-size", options.snapshot_size, "Their size").valueNamed("WxH").showsDefault();
  command.flag("--headless", options.plan.headless, "Without a window");
  command.flag("--force", options.plan.overwrite, "Replace outputs that exist");
  command.optionGroup("For engineers");
  command.flag("--verbose", options.plan.verbose,
               "Words for engineers on the terminal; keys 1 to 7 choose the force law");
  command.option("--law", options.law, "Force law: " + lawNames()).showsDefault();
  command
      .option("--preset", options.preset,
              "density-weighted: the feel of a published tooth-preparation simulator, volumetric sample points whose "
              "stiffness follows the density over the last 100 ticks; --set still changes it")
      .oneOf(feelPresets());
  command.option("--erosion", options.erosion, "Erosion law").oneOf(erosionNames()).showsDefault();
  command.option("--set", options.settings,
                 "key=value: stiffness_N_per_mm, peak_force_N, spindle_rpm, worn, removal_rate_per_s, …");
  command
      .option("--parameters", options.plan.parameters,
              "Settings file, TOML, applied whenever it changes (app/options/feel.toml); overrides --law and --set")
      .valueNamed("FILE");
  command.option("--rate", options.plan.rate_Hz, "Servo rate, Hz [1000, or as recorded]").from(500.0, 10'000.0);
  command
      .option("--priority", options.plan.device_options.servo_priority,
              "Real-time priority of the servo; the USB thread has the next")
      .wholeFrom(haptics::kMinServoPriority, haptics::kMaxServoPriority)
      .showsDefault();
  command.option("--pace", options.pace, "real; or fast: simulated input without a window, as fast as the machine can")
      .oneOf({"real", "fast"})
      .showsDefault();
  command.footer(keyHelp());
}

}  // namespace app
