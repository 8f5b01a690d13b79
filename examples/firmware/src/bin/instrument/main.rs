//! An instrument: events come in by an interrupt of the UART, their classes go out by the UART and six lines, one for each class.
//!
//! RTIC keeps the two sides apart: the interrupt decodes frames and fills the queue, the idle task classifies and
//! answers. They share the counts of the link alone.

#![no_std]
#![no_main]

use core::panic::PanicInfo;

use cortex_m_semihosting::debug::{self, EXIT_FAILURE};
use defmt_semihosting as _;

mod board;
mod clock;

#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use microimpact::instrument::link::{self, Encoder, Inlet, PROTOCOL, Received, Reply};
    use microimpact::instrument::{ClassLines, Instrument, Queue, Receiver, Sender};
    use microimpact_firmware::station::{
        BINS, CLASSES, Event, MESSAGE_BYTES, QUEUE, REPLY_BYTES, SCENE, Scenes, ToHost, ToInstrument, bins, classifier,
    };

    use crate::board::{self, Line, SerialInput, SerialOutput};
    use crate::clock::Clock;

    type Station = link::Station<Scenes, ClassLines<Line, CLASSES>, f32, CLASSES, BINS>;

    #[shared]
    struct Shared {
        inlet: Inlet<MESSAGE_BYTES>,
    }

    #[local]
    struct Local {
        input: SerialInput,
        sender: Sender<'static, ToInstrument>,
        receiver: Receiver<'static, ToInstrument>,
        station: Station,
        host: Host,
        clock: Clock,
    }

    /// The way to the host.
    pub struct Host {
        output: SerialOutput,
        encoder: Encoder<REPLY_BYTES>,
    }

    impl Host {
        fn tell(&mut self, reply: &ToHost) {
            match self.encoder.frame(reply) {
                Ok(frame) => self.output.write(frame),
                Err(fault) => defmt::error!("a reply does not fit into its frame: {}", fault),
            }
        }
    }

    #[init(local = [queue: Queue<ToInstrument, QUEUE> = Queue::new()])]
    fn init(context: init::Context) -> (Shared, Local) {
        let (Ok(scene), Ok(bins)) = (classifier(&SCENE), bins()) else {
            panic!("the station's values are outside their ranges");
        };
        let (input, output, lines) = board::start();
        let (sender, receiver) = context.local.queue.split();
        let local = Local {
            input,
            sender,
            receiver,
            station: Station::new(Instrument::new(scene, ClassLines::new(lines), bins)),
            host: Host { output, encoder: Encoder::new() },
            clock: Clock::new(context.core.SYST),
        };
        (Shared { inlet: Inlet::new() }, local)
    }

    /// Frames come in.
    #[task(binds = UART0, shared = [inlet], local = [input, sender], priority = 2)]
    fn receive(mut context: receive::Context) {
        context.local.input.acknowledge();
        while let Some(byte) = context.local.input.read() {
            if let Some(request) = context.shared.inlet.lock(|inlet| inlet.receive(byte)) {
                // The queue itself counts what finds it full.
                let _ = context.local.sender.send(request);
            }
        }
    }

    /// Answers go out.
    #[idle(shared = [inlet], local = [receiver, station, host, clock])]
    fn idle(mut context: idle::Context) -> ! {
        let idle::LocalResources { receiver, station, host, clock, .. } = context.local;
        defmt::info!("started, protocol {=u16}", PROTOCOL);
        host.tell(&station.started::<Event>());
        loop {
            let request = receiver.receive();
            #[cfg(feature = "busy")]
            if request.is_some() {
                cortex_m::asm::delay(microimpact_firmware::station::OTHER_WORK);
            }
            match request {
                Some(request) => {
                    let received = Received {
                        arrivals: context.shared.inlet.lock(|inlet| inlet.arrivals()),
                        lost: receiver.lost(),
                        ticks: clock.awake(),
                    };
                    let reply = station.answer(&request, &received, classifier);
                    if let Reply::Rejected { number, rejection } = &reply {
                        defmt::debug!("event {=u32} rejected: {}", number, rejection);
                    }
                    host.tell(&reply);
                }
                // An interrupt that comes between the question and the sleep ends the sleep at once, although it runs after it.
                None => cortex_m::interrupt::free(|_| {
                    if receiver.is_empty() {
                        clock.pause(cortex_m::asm::wfi);
                    }
                }),
            }
            clock.tick();
        }
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    if let Some(location) = info.location() {
        defmt::error!("panicked at {=str}:{=u32}", location.file(), location.line());
    }
    loop {
        // Ends the emulator; without one, a debugger stops here.
        debug::exit(EXIT_FAILURE);
    }
}
